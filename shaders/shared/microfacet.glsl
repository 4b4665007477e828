// Source of GLSL and of C++ (core/shade/shared_material.h, core/trace/lanes/shared.h): glTF's reflection model (glTF 2.0,
// appendix B), and light reflected by either model. Expects phong.glsl.
//   specular  F D V     D: GGX (Walter et al. 2007), V: height-correlated Smith (Heitz 2014), F: Schlick 1994
//   matt      base / pi (1 - F(V.H)), F that of the dielectric layer above. At grazing angles that returns up to 1.9
//             times the light: there it is limited to what the lobe leaves of light from all around.
//   sheen     above both (KHR_materials_sheen): Estevez and Kulla 2017, visibility by Neubelt and Pettineo 2013
//   coat      above all (KHR_materials_clearcoat): GGX with F0 0.04
// Sheen and coat take what they return from what lies below.
// Alpha is roughness squared, kLeastAlpha at least. A light without a size stands for a small lamp: its highlight is
// that of kLeastHighlight at least.

const float kPi = 3.14159265358979323846f;
const float kLeastAlpha = 0.0005f;
const float kLeastHighlight = 0.007f;
const float kAlone = 1e30f;  // weighs a density so that no other sample of the light counts
const float kCoatF0 = 0.04f;
const float kLeastSheenAlpha = 0.005f;
const float kLeastCosine = 0.001f;  // of the viewer's angle, where a mapped normal turns away

SHARED real fifth_power(real x) {
  real x2 = x * x;
  return x2 * x2 * x;
}

SHARED vec3 schlick(vec3 f0, real f90, real cosine) {
  return f0 + (vec3(f90) - f0) * fifth_power(1.0f - clamp(cosine, 0.0f, 1.0f));
}

// Density of microfacet normals, from the cosine and the squared sine of their angle.
SHARED real ggx(real cosine, real sine2, real alpha) {
  real a2 = alpha * alpha;
  real across = cosine * cosine * a2 + sine2;
  return a2 / (kPi * across * across);
}

// The masking and shadowing function divided by 4 (N.L) (N.V).
SHARED real ggx_visibility(real n_dot_l, real n_dot_v, real alpha) {
  real a2 = alpha * alpha;
  return 0.5f / (n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0f - a2) + a2) + n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0f - a2) + a2));
}

// Twice N.V over one plus Smith's function for the viewer: the density of visible normals is D (V.H) times that over
// N.V, of mirrored directions a quarter of it over V.H.
SHARED real ggx_viewed(real n_dot_v, real alpha) {
  real a2 = alpha * alpha;
  return 1.0f / (n_dot_v + sqrt(n_dot_v * n_dot_v * (1.0f - a2) + a2));
}

SHARED real cosine_of_view(vec3 n, vec3 to_viewer) { return max(dot(n, to_viewer), kLeastCosine); }

// The share of light from all around that GGX mirrors towards the viewer: x times F0 plus y times F90. Within 0.03, beyond
// grazing angles 0.01 (fitted to integrals: MaterialX 1.38, mx_ggx_dir_albedo_analytic); of surfaces that are smooth for
// the angle, where the fit is 0.03 too low, Schlick's formula itself.
SHARED vec2 ggx_albedo(real n_dot_v, real alpha) {
  real x = n_dot_v;
  real y = alpha;
  real x2 = x * x;
  real y2 = y * y;
  real a = 0.1003f - 0.6303f * x + 9.748f * y - 2.038f * x * y + 29.34f * x2 - 8.245f * y2 - 26.44f * x2 * y +
           19.99f * x * y2 - 5.448f * x2 * y2;
  real b = 0.9345f - 2.323f * x + 2.229f * y - 3.748f * x * y + 1.424f * x2 - 0.7684f * y2 + 1.436f * x2 * y +
           0.2913f * x * y2 + 0.6286f * x2 * y2;
  real of_a = 1.0f - 1.765f * x + 8.263f * y + 11.53f * x * y + 28.96f * x2 - 7.507f * y2 - 36.11f * x2 * y +
              15.86f * x * y2 + 33.37f * x2 * y2;
  real of_b = 1.0f + 0.2281f * x + 15.94f * y - 55.83f * x * y + 13.08f * x2 + 41.26f * y2 + 54.9f * x2 * y +
              300.2f * x * y2 - 285.1f * x2 * y2;
  vec2 fit = vec2(clamp(a / of_a, 0.0f, 1.0f), clamp(b / of_b, 0.0f, 1.0f));
  real polished = max(1.0f - 2.0f * alpha / max(n_dot_v, kLeastCosine), 0.0f);
  real fifth = fifth_power(1.0f - n_dot_v);
  return fit + polished * (vec2(1.0f - fifth, fifth) - fit);
}

// How high above the surface a mirrored ray stays, as a cosine, and as a share of the viewer's.
const float kLeastRise = 0.025f;
const float kLeastShareOfRise = 0.9f;

// A smooth or mapped normal may send the mirrored ray into the surface, or have the viewer behind it; it would be black.
// Such a normal is bent towards the geometric one, no further than needed: a smooth surface's so that the mirrored ray
// leaves the surface, a rough one's so that the viewer is before it. All are unit vectors, the geometric one is on the
// viewer's side.
SHARED vec3 normal_seen(vec3 n, vec3 n_geometric, vec3 to_viewer, real alpha) {
  real rise = dot(to_viewer, n_geometric);
  real steepness = dot(n, n_geometric);
  real faced = dot(n, to_viewer);
  real least = mix(min(kLeastShareOfRise * rise, kLeastRise), -kLeastShareOfRise * rise, alpha);
  boolean bent = faced <= 0.0f || steepness <= 0.0f || 2.0f * faced * steepness - rise < least;
  if (!any(bent)) return n;
  // In the plane of both normals, at the angle a from the geometric one, the mirrored ray rises to x sin 2a + rise cos 2a.
  vec3 across = n - steepness * n_geometric;
  real square = dot(across, across);
  across /= sqrt(max(square, 1e-20f));
  real x = dot(to_viewer, across);
  real all = x * x + rise * rise;
  real cosine = clamp((rise * least - x * sqrt(max(all - least * least, 0.0f))) / max(all, 1e-20f), -1.0f, 1.0f);
  vec3 turned = across * sqrt(0.5f - 0.5f * cosine) + n_geometric * sqrt(0.5f + 0.5f * cosine);
  return pick(bent, pick(square > 1e-12f, turned, n_geometric), n);
}

SHARED real coat_alpha(READ_ONLY(Layers) l) { return clamp(l.coat_roughness * l.coat_roughness, kLeastAlpha, 1.0f); }

SHARED real sheen_alpha(READ_ONLY(Layers) l) {
  return clamp(l.sheen_roughness * l.sheen_roughness, kLeastSheenAlpha, 1.0f);
}

SHARED real brightest(vec3 v) { return max(max(v.x, v.y), v.z); }

// The brightest share that the lobe mirrors of light from all around.
SHARED real lobe_share(READ_ONLY(ShadingParams) m, real alpha, real n_dot_v) {
  vec2 albedo = ggx_albedo(n_dot_v, alpha);
  return brightest(m.specular) * albedo.x + m.grazing * albedo.y;
}

SHARED real layer_fresnel(READ_ONLY(ShadingParams) m, real fifth) {
  return m.layer.x + (m.layer.y - m.layer.x) * fifth;
}

// The share of light from all around that reaches the matt part. The mean of (1 - V.H)^5 over that light is a polynomial
// within 1e-4.
SHARED real mean_below(READ_ONLY(ShadingParams) m, real n_dot_v) {
  real x = 1.0f - n_dot_v;
  return 1.0f - layer_fresnel(m, x * (0.0044f + x * (0.0257f * x - 0.002f)));
}

// The factor of the matt part: with it, lobe, matt part and what goes through return no more light than arrives.
SHARED real matt_limit(READ_ONLY(ShadingParams) m, real n_dot_v) {
  real matt = kPi * brightest(m.diffuse) * mean_below(m, n_dot_v) / max(1.0f - m.layer.z, 1e-6f);
  return min((1.0f - lobe_share(m, m.ggx_alpha, n_dot_v)) / max(matt, 1e-6f), 1.0f);
}

// Sheen's density of fibres, from the squared sine of their angle.
SHARED real charlie(real sine2, real alpha) {
  return (2.0f + 1.0f / alpha) * pow(max(sine2, 1e-12f), 0.5f / alpha) * (0.5f / kPi);
}

// The share of light from all around that white sheen returns, above 1 for smooth fibres at grazing angles. Fitted to
// integrals: on average within 0.005, at most 0.03.
SHARED real sheen_albedo(real n_dot_v, real alpha) {
  real x = n_dot_v;
  real y = alpha;
  real x2 = x * x;
  real y2 = y * y;
  real of_all = 25.8489f + x * (199.082f - 2717.18f * x + 3191.62f * x2) + y * (5145.74f + 43395.4f * y + 20032.4f * y2) +
                x * y * (67651.5f - 104780.0f * x + 263678.0f * y - 113015.0f * x * y);
  real all = 1.0f + x * (156.716f + 44315.3f * x2) + y * (1399.29f + 54872.3f * y + 54731.7f * y2) +
             x * y * (51831.1f + 169364.0f * x + 819080.0f * y + 112098.0f * x * y);
  return of_all / all;
}

// The material with what sheen and coat leave of the light to what lies below them, for one viewer.
SHARED ShadingParams below_layers(vec3 to_viewer, vec3 n, READ_ONLY(ShadingParams) m) {
  ShadingParams below = m;
  real away = fifth_power(1.0f - cosine_of_view(m.coat_normal, to_viewer));
  below.layers.coat = m.layers.coat * (kCoatF0 + (1.0f - kCoatF0) * away);
  real left = 1.0f - below.layers.coat;
  if (any(m.layers.sheen != vec3(0.0f))) {
    real returned = brightest(m.layers.sheen) * sheen_albedo(cosine_of_view(n, to_viewer), sheen_alpha(m.layers));
    below.layers.sheen = m.layers.sheen * (left / max(returned, 1.0f));
    left = left * (1.0f - min(returned, 1.0f));
  }
  below.diffuse = m.diffuse * left;
  below.specular = m.specular * left;
  below.grazing = m.grazing * left;
  below.emission = m.emission * left;
  return below;
}

// The matt part for one viewer, without what layers take. Phong's is the same for all.
SHARED vec3 viewed_diffuse(vec3 to_viewer, vec3 n, READ_ONLY(ShadingParams) m) {
  return pick(m.ggx_alpha > 0.0f, m.diffuse * matt_limit(m, cosine_of_view(n, to_viewer)), m.diffuse);
}

// The parameters for one viewer. Phong's are the same for all.
SHARED ShadingParams viewed_from(vec3 to_viewer, vec3 n, READ_ONLY(ShadingParams) m) {
  ShadingParams viewed = m;
  if (any(m.ggx_alpha > 0.0f)) {
    viewed.diffuse = viewed_diffuse(to_viewer, n, m);
    if (any(m.layers.coat > 0.0f || m.layers.sheen != vec3(0.0f))) viewed = below_layers(to_viewer, n, viewed);
  }
  return viewed;
}

// The brightest share of light from all around that lobe and coat mirror. viewed: parameters for one viewer.
SHARED real mirrored_share(READ_ONLY(ShadingParams) viewed, real n_dot_v) {
  return lobe_share(viewed, viewed.ggx_alpha, n_dot_v) + viewed.layers.coat;
}

// How often a sample of the lobe, as wide as `alpha`, is one of the coat's.
SHARED real coat_chance(READ_ONLY(ShadingParams) viewed, real alpha, real n_dot_v) {
  return viewed.layers.coat / max(lobe_share(viewed, alpha, n_dot_v) + viewed.layers.coat, 1e-6f);
}

// A direction of the lobe, and the density with which it is sampled, per steradian.
struct LobeLight {
  vec3 reflected;  // share of the light from there, times N.L
  real density;
  real below;  // share of that light that reaches the matt part
};

SHARED vec3 halfway(vec3 to_viewer, vec3 to_light) {
  vec3 sum = to_viewer + to_light;
  return sum * (1.0f / sqrt(max(dot(sum, sum), 1e-20f)));
}

// m: parameters for one viewer. Lobe and coat have the widths `alpha` and `alpha_of_coat`.
SHARED LobeLight lobe_light(READ_ONLY(ShadingParams) m, real alpha, real alpha_of_coat, vec3 n, vec3 to_viewer,
                            vec3 to_light) {
  vec3 h = halfway(to_viewer, to_light);
  vec3 off = cross(n, h);
  real n_dot_v = cosine_of_view(n, to_viewer);
  real n_dot_l = max(dot(n, to_light), 0.0f);
  real d = ggx(dot(n, h), dot(off, off), alpha);
  LobeLight result;
  real fifth = fifth_power(1.0f - clamp(dot(to_viewer, h), 0.0f, 1.0f));
  result.below = 1.0f - layer_fresnel(m, fifth);
  result.reflected = (m.specular + (vec3(m.grazing) - m.specular) * fifth) *
                     (d * ggx_visibility(max(n_dot_l, 1e-7f), n_dot_v, alpha) * n_dot_l);
  result.density = 0.5f * d * ggx_viewed(n_dot_v, alpha);
  if (any(m.layers.coat > 0.0f)) {
    vec3 off_coat = cross(m.coat_normal, h);
    real coat_dot_v = cosine_of_view(m.coat_normal, to_viewer);
    real coat_dot_l = max(dot(m.coat_normal, to_light), 0.0f);
    real coat_d = ggx(dot(m.coat_normal, h), dot(off_coat, off_coat), alpha_of_coat);
    real visible = ggx_visibility(max(coat_dot_l, 1e-7f), coat_dot_v, alpha_of_coat);
    result.reflected += vec3(m.layers.coat * (coat_d * visible * coat_dot_l));
    real density = 0.5f * coat_d * ggx_viewed(coat_dot_v, alpha_of_coat);
    result.density = result.density + (density - result.density) * coat_chance(m, alpha, n_dot_v);
  }
  return result;
}

// What sheen returns of light from there, times N.L.
SHARED vec3 sheen_light(READ_ONLY(ShadingParams) m, vec3 n, vec3 to_viewer, vec3 to_light) {
  vec3 off = cross(n, halfway(to_viewer, to_light));
  real n_dot_v = cosine_of_view(n, to_viewer);
  real n_dot_l = max(dot(n, to_light), 0.0f);
  real visible = 0.25f / (n_dot_l + n_dot_v - n_dot_l * n_dot_v);
  return m.layers.sheen * (charlie(dot(off, off), sheen_alpha(m.layers)) * visible * n_dot_l);
}

// A microfacet's normal as the viewer sees them (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4),
// 2018), from a point of the unit disc. All vectors have the normal as their third axis.
SHARED vec3 visible_normal(vec3 to_viewer, real alpha, vec2 disc) {
  vec3 v = vec3(to_viewer.x * alpha, to_viewer.y * alpha, to_viewer.z);
  v /= sqrt(dot(v, v));
  real square = v.x * v.x + v.y * v.y;
  boolean tilted = square > 0.0f;
  real inverse = 1.0f / sqrt(pick(tilted, square, 1.0f));
  vec3 t = pick(tilted, vec3(-v.y * inverse, v.x * inverse, 0.0f), vec3(1.0f, 0.0f, 0.0f));
  vec3 u = cross(v, t);
  real rest = max(1.0f - disc.x * disc.x, 0.0f);
  real s = 0.5f * (1.0f + v.z);
  real y = (1.0f - s) * sqrt(rest) + s * disc.y;
  vec3 h = t * disc.x + u * y + v * sqrt(max(rest - y * y, 0.0f));
  vec3 stretched = vec3(h.x * alpha, h.y * alpha, max(h.z, 1e-6f));
  return stretched * (1.0f / sqrt(dot(stretched, stretched)));
}

// What one light adds where it reaches the point of those parameters (viewed_from): where `lit` holds, the light is before
// n. n, to_viewer and incident.to_light are unit vectors. lobe: 1 where rays along the lobe look for lights with a size
// too, so that a sample of such a light counts in part (Veach and Guibas 1995, balance heuristic); else 0.
SHARED vec3 reflected_light(READ_ONLY(ShadingParams) m, READ_ONLY(Incident) incident, vec3 n, vec3 to_viewer, boolean lit,
                            real lobe) {
  vec3 sum = phong_light(m, incident, n, to_viewer, lit && m.ggx_alpha <= 0.0f);
  boolean glossy = lit && m.ggx_alpha > 0.0f;
  if (any(glossy)) {
    boolean sized = incident.density > 0.0f;
    real least = pick(sized, kLeastAlpha, kLeastHighlight);
    LobeLight light = lobe_light(m, max(m.ggx_alpha, least), max(coat_alpha(m.layers), least), n, to_viewer,
                                 incident.to_light);
    real counts = pick(sized, incident.density / (incident.density + lobe * light.density), 1.0f);
    vec3 share = m.diffuse * (light.below * dot(n, incident.to_light)) + light.reflected * counts;
    if (any(m.layers.sheen != vec3(0.0f))) share += sheen_light(m, n, to_viewer, incident.to_light);
    sum = pick(glossy, incident.radiance * share, sum);
  }
  return sum;
}

// Source of GLSL and of C++ (core/trace/lanes/prefiltered.h): an environment's light without samples. What a surface
// returns of it is split into means (Karis 2013, "Real shading in Unreal Engine 4"): light averaged over the lobe's
// directions, times the share that the lobe returns of light from all around. The sky casts no shadows.
// Expects microfacet.glsl.

// Each side defines SkyIrradiance, whose c are the nine coefficients of 1, y, z, x, xy, yz, 3 zz - 1, xz, xx - yy in the
// irradiance of a surface that faces (x, y, z) (Ramamoorthi and Hanrahan 2001).
SHARED vec3 irradiance_at(SkyIrradiance sky, vec3 n) {
  vec3 light = vec3(sky.c[0]) + vec3(sky.c[1]) * n.y + vec3(sky.c[2]) * n.z + vec3(sky.c[3]) * n.x +
               vec3(sky.c[4]) * (n.x * n.y) + vec3(sky.c[5]) * (n.y * n.z) + vec3(sky.c[6]) * (3.0f * n.z * n.z - 1.0f) +
               vec3(sky.c[7]) * (n.x * n.z) + vec3(sky.c[8]) * (n.x * n.x - n.y * n.y);
  return vec3(max(light.x, 0.0f), max(light.y, 0.0f), max(light.z, 0.0f));
}

// The direction about which the lobe of a rough surface lies: rougher ones lean towards the normal (Lagarde and de
// Rousiers 2014, "Moving Frostbite to physically based rendering", 4.9).
SHARED vec3 lobe_axis(vec3 n, vec3 mirrored, real alpha) {
  real share = (1.0f - alpha) * (sqrt(1.0f - alpha) + alpha);
  vec3 axis = n + (mirrored - n) * share;
  return axis * (1.0f / sqrt(max(dot(axis, axis), 1e-12f)));
}

// GGX's alpha of a lobe as wide as Phong's highlight, whose exponent is about a quarter of Blinn's.
SHARED real alpha_of_phong(real shininess) { return sqrt(2.0f / (4.0f * shininess + 2.0f)); }

// The share of light from all around that Phong's highlight returns.
SHARED vec3 phong_albedo(READ_ONLY(ShadingParams) m) { return m.specular * (2.0f * kPi / (m.shininess + 1.0f)); }

// The share of light from all around that the lobe mirrors. viewed: parameters for one viewer.
SHARED vec3 lobe_albedo(READ_ONLY(ShadingParams) viewed, real n_dot_v) {
  vec2 albedo = ggx_albedo(n_dot_v, viewed.ggx_alpha);
  return viewed.specular * albedo.x + vec3(viewed.grazing * albedo.y);
}

// What matt part and sheen return.
SHARED vec3 matt_albedo(READ_ONLY(ShadingParams) viewed, real n_dot_v) {
  vec3 share = viewed.diffuse * (kPi * mean_below(viewed, n_dot_v));
  if (any(viewed.layers.sheen != vec3(0.0f)))
    share += viewed.layers.sheen * sheen_albedo(n_dot_v, sheen_alpha(viewed.layers));
  return share;
}

#include "core/reference/reference_lobe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr double kPi = std::numbers::pi;

double cosine_of_view(const glm::dvec3& n, const ReferenceSurface& s) {
  return std::max(glm::dot(n, s.to_viewer), 0.001);  // as shaders/shared/microfacet.glsl
}
double cosine_of_view(const ReferenceSurface& s) {
  return cosine_of_view(s.n_shading, s);
}

// Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, equation 33. The
// tangent comes from the sine, which keeps its digits where the angle is small.
double facet_density(const glm::dvec3& n, const glm::dvec3& h, double alpha) {
  const double cosine = glm::dot(n, h),
               tangent2 = glm::dot(glm::cross(n, h), glm::cross(n, h)) / square(cosine);
  if (cosine <= 0.0) return 0.0;
  return square(alpha) / (kPi * square(square(cosine)) * square(square(alpha) + tangent2));
}

// Smith's auxiliary function (Heitz, "Understanding the Masking-Shadowing Function", JCGT 3(2), 2014).
double lambda(double cosine, double alpha) {
  return 0.5 * (std::sqrt(1.0 + square(alpha) * (1.0 / square(cosine) - 1.0)) - 1.0);
}

double shadowing(double n_dot_l, double n_dot_v, double alpha) {
  return 1.0 / (1.0 + lambda(n_dot_l, alpha) + lambda(n_dot_v, alpha));
}

// The share of light from all around that the lobe mirrors: the model's definition is this fit to the
// integrals (MaterialX 1.38, mx_ggx_dir_albedo_analytic), and Schlick's formula where the surface is smooth
// for the angle.
double albedo(double f0, double f90, double x, double y) {
  const double of[9] = {1.0, x, y, x * y, x * x, y * y, x * x * y, x * y * y, x * x * y * y};
  constexpr double k[4][9] = {{0.1003, -0.6303, 9.748, -2.038, 29.34, -8.245, -26.44, 19.99, -5.448},
                              {0.9345, -2.323, 2.229, -3.748, 1.424, -0.7684, 1.436, 0.2913, 0.6286},
                              {1.0, -1.765, 8.263, 11.53, 28.96, -7.507, -36.11, 15.86, 33.37},
                              {1.0, 0.2281, 15.94, -55.83, 13.08, 41.26, 54.9, 300.2, -285.1}};
  double sum[4] = {};
  for (int row = 0; row < 4; ++row)
    for (int i = 0; i < 9; ++i) sum[row] += k[row][i] * of[i];
  const double polished = std::max(1.0 - 2.0 * y / x, 0.0), fifth = std::pow(1.0 - x, 5.0);
  const auto blended = [&](double fit, double exact) { return fit + polished * (exact - fit); };
  return f0 * blended(std::clamp(sum[0] / sum[2], 0.0, 1.0), 1.0 - fifth) +
         f90 * blended(std::clamp(sum[1] / sum[3], 0.0, 1.0), fifth);
}

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

// Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", 2017, with the visibility of Neubelt and
// Pettineo, "Crafting a Next-Gen Material Pipeline for The Order: 1886", 2013. Times the light's cosine.
double sheen_of(double sine2_of_h, double n_dot_l, double n_dot_v, double alpha) {
  const double d = (2.0 + 1.0 / alpha) * std::pow(sine2_of_h, 0.5 / alpha) / (2.0 * kPi);
  return d * n_dot_l / (4.0 * (n_dot_l + n_dot_v - n_dot_l * n_dot_v));
}

// The integral of sheen_of over all light.
double sheen_albedo(double n_dot_v, double alpha) {
  constexpr int kSide = 64;
  const double sine_v = std::sqrt(std::max(1.0 - square(n_dot_v), 0.0));
  double sum = 0.0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double z = (i % kSide + 0.5) / kSide, phi = (i / kSide + 0.5) / kSide * kPi;
    const double sine_l = std::sqrt(1.0 - square(z));
    const glm::dvec3 h =
        glm::normalize(glm::dvec3(sine_l * std::cos(phi) + sine_v, sine_l * std::sin(phi), z + n_dot_v));
    sum += sheen_of(std::max(1.0 - square(h.z), 1e-12), z, n_dot_v, alpha);
  }
  return 2.0 * kPi * sum / square(kSide);
}

// Looked up in a table, as every point needs it.
double tabulated_sheen_albedo(double n_dot_v, double alpha) {
  constexpr int kSide = 48;
  static const std::vector<double> table = [] {
    std::vector<double> made;
    for (int i = 0; i <= kSide; ++i)
      for (int k = 0; k <= kSide; ++k)
        made.push_back(sheen_albedo(std::max(square(as_double(k) / kSide), 0.001),
                                    std::max(square(as_double(i) / kSide), 0.005)));
    return made;
  }();
  const double x = kSide * std::sqrt(n_dot_v), y = kSide * std::sqrt(alpha);
  const int k = std::min(as_int(x), kSide - 1), i = std::min(as_int(y), kSide - 1);
  const auto row = [&](int r) {
    const double* const from = &table[as_size(r * (kSide + 1) + k)];
    return from[0] + (x - k) * (from[1] - from[0]);
  };
  return row(i) + (y - i) * (row(i + 1) - row(i));
}

double sheen_alpha(const ReferenceSurface& s) {
  return squared_roughness(s.material.layers.sheen_roughness, 0.005);
}

double sheen_returned(const ReferenceSurface& s) {
  if (s.material.layers.sheen == glm::dvec3(0.0)) return 0.0;
  return largest(s.material.layers.sheen) * tabulated_sheen_albedo(cosine_of_view(s), sheen_alpha(s));
}

}  // namespace

ReferenceFacets reference_base(const ReferenceSurface& s) {
  return {s.n_shading, s.material.ggx_alpha};
}

ReferenceFacets reference_coat(const ReferenceSurface& s) {
  return {s.n_coat, s.material.layers.coat_alpha()};
}

double reference_coat_share(const ReferenceSurface& s) {
  if (s.material.layers.coat == 0.0) return 0.0;
  return s.material.layers.coat * (0.04 + 0.96 * std::pow(1.0 - cosine_of_view(reference_coat(s).n, s), 5.0));
}

double reference_below_layers(const ReferenceSurface& s) {
  return (1.0 - reference_coat_share(s)) * (1.0 - std::min(sheen_returned(s), 1.0));
}

glm::dvec3 reference_sheen(const ReferenceSurface& s, const glm::dvec3& to_light) {
  const double n_dot_l = glm::dot(s.n_shading, to_light);
  if (s.material.layers.sheen == glm::dvec3(0.0) || n_dot_l <= 0.0) return glm::dvec3(0.0);
  const glm::dvec3 h = glm::normalize(to_light + s.to_viewer);
  const double sine2 = std::max(1.0 - square(glm::dot(s.n_shading, h)), 1e-12);
  return (1.0 - reference_coat_share(s)) / std::max(sheen_returned(s), 1.0) *
         sheen_of(sine2, n_dot_l, cosine_of_view(s), sheen_alpha(s)) * s.material.layers.sheen;
}

glm::dvec3 reference_matt(const ReferenceSurface& s, const glm::dvec3& to_light) {
  const ReferenceMaterial& m = s.material;
  const double n_dot_v = cosine_of_view(s), away = 1.0 - n_dot_v;
  const auto mirrored = [&m](double fifth) { return m.layer.x + (m.layer.y - m.layer.x) * fifth; };
  const double mean_fifth = 0.0257 * away * away * away - 0.002 * away * away + 0.0044 * away;
  const double all =
      std::numbers::pi * largest(m.diffuse) * (1.0 - mirrored(mean_fifth)) / std::max(1.0 - m.layer.z, 1e-6);
  const double left = 1.0 - albedo(largest(m.specular), m.grazing, n_dot_v, m.ggx_alpha);
  const double cosine = std::clamp(glm::dot(s.to_viewer, glm::normalize(s.to_viewer + to_light)), 0.0, 1.0);
  return std::min(left / std::max(all, 1e-6), 1.0) * (1.0 - mirrored(std::pow(1.0 - cosine, 5.0))) *
         m.diffuse;
}

glm::dvec3 reference_schlick(const ReferenceMaterial& m, double cosine) {
  return m.specular +
         (glm::dvec3(m.grazing) - m.specular) * std::pow(1.0 - std::clamp(cosine, 0.0, 1.0), 5.0);
}

double reference_mirrored(const ReferenceSurface& s, const ReferenceFacets& facets,
                          const glm::dvec3& to_light) {
  const double n_dot_l = glm::dot(facets.n, to_light), n_dot_v = cosine_of_view(facets.n, s);
  if (n_dot_l <= 0.0) return 0.0;
  const glm::dvec3 h = glm::normalize(to_light + s.to_viewer);
  return facet_density(facets.n, h, facets.alpha) * shadowing(n_dot_l, n_dot_v, facets.alpha) /
         (4.0 * n_dot_v);
}

double reference_lobe_density(const ReferenceSurface& s, const ReferenceFacets& facets,
                              const glm::dvec3& to_light) {
  const glm::dvec3 h = glm::normalize(to_light + s.to_viewer);
  const double v_dot_h = glm::dot(s.to_viewer, h);
  if (v_dot_h <= 0.0) return 0.0;
  return facet_density(facets.n, h, facets.alpha) * glm::dot(facets.n, h) / (4.0 * v_dot_h);
}

std::vector<ReferenceLobe> reference_lobe_samples(const ReferenceSurface& s, const ReferenceFacets& facets,
                                                  int side) {
  const double alpha = facets.alpha, n_dot_v = cosine_of_view(facets.n, s);
  std::vector<ReferenceLobe> samples;
  reference_cells(side, s.p_world, [&](const glm::dvec2& cell) {
    const double tangent = alpha * std::sqrt(cell.x / (1.0 - cell.x));
    const glm::dvec3 h = reference_beside(facets.n, 1.0 / std::sqrt(1.0 + square(tangent)), cell.y);
    const double v_dot_h = glm::dot(s.to_viewer, h), n_dot_h = glm::dot(facets.n, h);
    const glm::dvec3 l = 2.0 * v_dot_h * h - s.to_viewer;
    const double n_dot_l = glm::dot(facets.n, l), outside = glm::dot(s.n_geometric, l);
    if (v_dot_h <= 0.0 || n_dot_l <= 0.0) return;
    const double share =
        shadowing(n_dot_l, n_dot_v, alpha) * v_dot_h / (n_dot_v * n_dot_h * as_double(side * side));
    // A direction into the surface is mirrored by its plane; no other method finds it.
    if (outside > 0.0)
      samples.push_back({h, l, share, facet_density(facets.n, h, alpha) * n_dot_h / (4.0 * v_dot_h)});
    else
      samples.push_back({h, l - 2.0 * outside * s.n_geometric, share, 0.0});
  });
  return samples;
}

}  // namespace pinocchio

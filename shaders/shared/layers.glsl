// Source of GLSL and of C++ (core/shade/shared_material.h, core/trace/lanes/shared.h): the layers above the base of
// a glTF surface, KHR_materials_clearcoat and KHR_materials_sheen. microfacet.glsl says how they reflect.

struct Layers {
  real coat;  // factor; viewed_from makes it the share that the coat mirrors
  real coat_roughness;
  vec3 sheen;  // colour; black: none
  real sheen_roughness;
};

// The members of GltfLayers (pinocchio/gltf_layers.h) in their order, filled up with zeros.
SHARED Layers layers_of(READ_ONLY(vec4) first, READ_ONLY(vec4) second) {
  Layers l;
  l.coat = first.x;
  l.coat_roughness = first.y;
  l.sheen = vec3(first.z, first.w, second.x);
  l.sheen_roughness = second.y;
  return l;
}

SHARED Layers no_layers() { return layers_of(vec4(0.0f), vec4(0.0f)); }

// Values of textures times factors.
SHARED Layers layers_times(READ_ONLY(Layers) a, READ_ONLY(Layers) b) {
  Layers l;
  l.coat = a.coat * b.coat;
  l.coat_roughness = a.coat_roughness * b.coat_roughness;
  l.sheen = a.sheen * b.sheen;
  l.sheen_roughness = a.sheen_roughness * b.sheen_roughness;
  return l;
}

SHARED Layers pick_layers(boolean condition, READ_ONLY(Layers) yes, READ_ONLY(Layers) no) {
  Layers l;
  l.coat = pick(condition, yes.coat, no.coat);
  l.coat_roughness = pick(condition, yes.coat_roughness, no.coat_roughness);
  l.sheen = pick(condition, yes.sheen, no.sheen);
  l.sheen_roughness = pick(condition, yes.sheen_roughness, no.sheen_roughness);
  return l;
}

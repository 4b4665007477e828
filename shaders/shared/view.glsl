// Source of GLSL and of C++ (core/shade/shared.h): a pixel's ray. Both sides build it from the same
// ViewParams, so a pixel of the GPU and a ray of the CPU see the same point.

struct ViewParams {
  vec3 eye;     // p_world of the pinhole; of parallel rays, where the top left pixel's begins
  vec3 corner;  // direction through the centre of the top left pixel; its forward component is 1
  vec3 step_x;  // one pixel to the right
  vec3 step_y;  // one pixel down
  vec2 first;   // the picture's pixel at (0, 0): not zero where only a part is drawn
  bool parallel;  // rays have one direction, `corner`, and begin `step_x` and `step_y` apart
};

// Not a unit vector: its length along the view axis is 1, so t along the ray is z_eye.
SHARED vec3 pixel_direction(ViewParams view, vec2 pixel) {
  if (view.parallel) return view.corner;
  vec2 at = view.first + pixel;  // whole numbers: a part's rays are the whole's to the last bit
  return view.corner + at.x * view.step_x + at.y * view.step_y;
}

// p_world where the pixel's ray begins.
SHARED vec3 pixel_origin(ViewParams view, vec2 pixel) {
  if (!view.parallel) return view.eye;
  vec2 at = view.first + pixel;
  return view.eye + at.x * view.step_x + at.y * view.step_y;
}

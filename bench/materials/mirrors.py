"""An integrator of Mitsuba's ("mirrors") that follows what ours follows: direct light by both parts of a material, light from other surfaces by the mirroring part alone.

For materials that heed the context's type mask ("gltf"). Light and material are sampled together, weighted by the power heuristic.
"""


def register(mi, dr):
    def weight_of(a, b):
        return dr.select(a > 0, dr.square(a) / dr.maximum(dr.square(a) + dr.square(b), 1e-30), 0)

    class Mirrors(mi.SamplingIntegrator):
        def __init__(self, props):
            mi.SamplingIntegrator.__init__(self, props)
            self.bounces = props.get("bounces", 3)

        def sample(self, scene, sampler, ray, medium=None, active=True):
            whole, mirror = mi.BSDFContext(), mi.BSDFContext()
            mirror.type_mask = int(mi.BSDFFlags.GlossyReflection)
            result, throughput = mi.Spectrum(0.0), mi.Spectrum(1.0)
            si = scene.ray_intersect(mi.Ray3f(ray), active)
            valid = si.is_valid()
            active = valid & active
            for _ in range(self.bounces + 1):
                bsdf = si.bsdf()
                light, radiance = scene.sample_emitter_direction(si, sampler.next_2d(active), True, active)
                value, density = bsdf.eval_pdf(whole, si, si.to_local(light.d), active)
                result += dr.select(active & (light.pdf > 0), throughput * value * radiance * weight_of(light.pdf, density), 0)

                found, weight = bsdf.sample(whole, si, sampler.next_1d(active), sampler.next_2d(active), active)
                active &= found.pdf > 0
                left = bsdf.eval(mirror, si, found.wo, active) / dr.maximum(found.pdf, 1e-30)
                other = scene.ray_intersect(si.spawn_ray(si.to_world(found.wo)), active)
                missed = active & ~other.is_valid()
                likely = scene.pdf_emitter_direction(si, mi.DirectionSample3f(scene, other, si), missed)
                sky = scene.environment().eval(other, missed)
                result += dr.select(missed, throughput * weight * sky * weight_of(found.pdf, likely), 0)
                throughput *= left
                si = other
                active &= other.is_valid()
            return result, valid, []

        def to_string(self):
            return "Mirrors[]"

    mi.register_integrator("mirrors", lambda props: Mirrors(props))

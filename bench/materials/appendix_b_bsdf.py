"""glTF's reflection model as a material of Mitsuba's ("gltf"): the reference under skies that are not even, and of textured models.

The formulas of appendix B as they stand (the coupling "mix" of appendix_b.py); scattering once. Lobes are sampled by visible normals and by the cosine.
`base_color`, `metallic` and `roughness` are textures, or numbers that may be set later.
"""
import math

F0 = 0.04
LEAST_ALPHA = 1e-3


def register(mi, dr):
    class Gltf(mi.BSDF):
        def __init__(self, props):
            mi.BSDF.__init__(self, props)
            found = {name: props[name] for name in ("base_color", "metallic", "roughness")}
            self.base = found["base_color"] if isinstance(found["base_color"], mi.Texture) else mi.Color3f(found["base_color"])
            self.metallic, self.roughness = (found[n] if isinstance(found[n], mi.Texture) else mi.Float(found[n]) for n in ("metallic", "roughness"))
            flags = mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
            self.m_components = [flags]
            self.m_flags = flags

        def surface(self, si, active):
            """Base colour, metallic and alpha at a point."""
            colour = self.base.eval(si, active) if isinstance(self.base, mi.Texture) else self.base
            one = lambda x: x.eval_1(si, active) if isinstance(x, mi.Texture) else x
            return colour, one(self.metallic), dr.maximum(dr.square(one(self.roughness)), LEAST_ALPHA)

        def mirror_share(self, wi, colour, metallic):
            """How often the mirroring lobe is sampled."""
            grazing = (1 - wi.z) ** 5
            bright = lambda c: (c.x + c.y + c.z) / 3
            mirror = (1 - metallic) * (F0 + (1 - F0) * grazing) + metallic * bright(colour + (1 - colour) * grazing)
            matt = (1 - metallic) * bright(colour)
            return dr.clip(mirror / dr.maximum(mirror + matt, 1e-6), 0.2, 1.0)

        @staticmethod
        def lambda_of(z, alpha):
            tangent2 = (1 - z * z) / dr.maximum(z * z, 1e-12)
            return 0.5 * (dr.sqrt(1 + alpha * alpha * dr.maximum(tangent2, 0)) - 1)

        def values(self, ctx, si, wo, active):
            """The BRDF times the cosine, and the density of sampling that direction. A context may leave the matt part out."""
            wi = si.wi
            colour, metallic, alpha = self.surface(si, active)
            up = active & (wi.z > 0) & (wo.z > 0)
            nv, nl = dr.maximum(wi.z, 1e-6), dr.maximum(wo.z, 1e-6)
            h = dr.normalize(wi + wo)
            vh = dr.clip(dr.dot(wi, h), 0, 1)
            spread = h.x * h.x + h.y * h.y + alpha * alpha * h.z * h.z
            d = alpha * alpha / (math.pi * spread * spread)
            of_view, of_light = self.lambda_of(nv, alpha), self.lambda_of(nl, alpha)
            mirror = d / ((1 + of_view + of_light) * 4 * nv)  # times the cosine
            grazing = (1 - vh) ** 5
            dielectric = F0 + (1 - F0) * grazing
            matt = nl / math.pi * (1 - dielectric) if mi.has_flag(ctx.type_mask, mi.BSDFFlags.DiffuseReflection) else 0.0
            value = (1 - metallic) * (colour * matt + mirror * dielectric) + metallic * mirror * (colour + (1 - colour) * grazing)
            share = self.mirror_share(wi, colour, metallic)
            density = share * d / ((1 + of_view) * 4 * nv) + (1 - share) * nl / math.pi
            return dr.select(up, value, 0), dr.select(up, density, 0)

        def sample(self, ctx, si, sample1, sample2, active):
            wi = si.wi
            colour, metallic, alpha = self.surface(si, active)
            share = self.mirror_share(wi, colour, metallic)
            stretched = dr.normalize(mi.Vector3f(alpha * wi.x, alpha * wi.y, wi.z))
            z = (1 - sample2.y) * (1 + stretched.z) - stretched.z
            around = dr.safe_sqrt(1 - z * z)
            turn = 2 * math.pi * sample2.x
            cap = mi.Vector3f(around * dr.cos(turn), around * dr.sin(turn), z) + stretched
            h = dr.normalize(mi.Vector3f(alpha * cap.x, alpha * cap.y, dr.maximum(cap.z, 1e-9)))
            mirrored = 2 * dr.dot(wi, h) * h - wi
            wo = dr.select(sample1 < share, mirrored, mi.warp.square_to_cosine_hemisphere(sample2))
            value, density = self.values(ctx, si, wo, active)
            found = dr.zeros(mi.BSDFSample3f)
            found.wo, found.pdf, found.eta = wo, density, 1.0
            found.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
            found.sampled_component = mi.UInt32(0)
            good = active & (density > 0)
            return found, dr.select(good, value / dr.maximum(density, 1e-30), 0)

        def eval(self, ctx, si, wo, active):
            return self.values(ctx, si, wo, active)[0]

        def pdf(self, ctx, si, wo, active):
            return self.values(ctx, si, wo, active)[1]

        def eval_pdf(self, ctx, si, wo, active):
            return self.values(ctx, si, wo, active)

        def to_string(self):
            return "Gltf[]"

    mi.register_bsdf("gltf", lambda props: Gltf(props))

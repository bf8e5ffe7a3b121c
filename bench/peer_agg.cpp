/* peer_agg.cpp - Anti-Grain Geometry: rasterizer_scanline_aa and scanline_u8 into grey8.
 *
 * The rasteriser is kept from picture to picture, with the memory it has taken, as AGG's users do;
 * feeding it the vertices is part of its rasterising and timed. Coordinates become 24.8 fixed
 * point. */
#include "peers.h"

#include <agg2/agg_pixfmt_gray.h>
#include <agg2/agg_rasterizer_scanline_aa.h>
#include <agg2/agg_renderer_base.h>
#include <agg2/agg_renderer_scanline.h>
#include <agg2/agg_rendering_buffer.h>
#include <agg2/agg_scanline_u.h>

#include <cstring>

namespace {

typedef agg::renderer_base<agg::pixfmt_gray8> Base;
typedef agg::renderer_scanline_aa_solid<Base> Renderer;

struct Picture { Scene scene; unsigned char *pixels; };

void *prepare(const Scene *scene, unsigned char *pixels)
{
	return new Picture{ *scene, pixels };
}

void release(void *picture)
{
	delete static_cast<Picture *>(picture);
}

void draw(void *picture)
{
	static agg::rasterizer_scanline_aa<> rasterizer;
	static agg::scanline_u8 scanline;
	const Picture *p = static_cast<const Picture *>(picture);
	const Scene &s = p->scene;
	std::memset(p->pixels, 0, size_t(s.stride) * size_t(s.height));
	agg::rendering_buffer buffer(p->pixels, unsigned(s.width), unsigned(s.height), s.stride);
	agg::pixfmt_gray8 format(buffer);
	Base base(format);
	Renderer renderer(base);
	renderer.color(agg::gray8(255));
	rasterizer.reset();
	for (size_t i = 0; i < s.rings; ++i) {
		const int32_t first = s.offsets[i];
		rasterizer.move_to_d(s.x[first], s.y[first]);
		for (int32_t k = first + 1; k < s.offsets[i + 1]; ++k)
			rasterizer.line_to_d(s.x[k], s.y[k]);
	}
	agg::render_scanlines(rasterizer, scanline, renderer);
}

}

const Painter painter_AGG = { prepare, release, draw, nullptr };

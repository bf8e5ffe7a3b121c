/* raster_downsample.c - the filter pass of 8 x 8 supersampling.
 *
 * Separable and polyphase: only pixels that are wanted are computed, first down the columns, eight
 * rows at a time over whole rows, then across, sixteen products side by side. It is what one would
 * write who cares for speed but not for intrinsics, and is compiled as the peers are: -O3 for this
 * machine, contraction allowed. */
#include "raster.h"

#include <string.h>

enum { ROWS = 8, LANES = 16 };

static void add_rows(const float *w, const float *const *in, int columns, float *restrict out)
{
	const float *a = in[0], *b = in[1], *c = in[2], *d = in[3];
	const float *e = in[4], *f = in[5], *g = in[6], *h = in[7];
	for (int i = 0; i < columns; ++i)
		out[i] += ((w[0] * a[i] + w[1] * b[i]) + (w[2] * c[i] + w[3] * d[i]))
			+ ((w[4] * e[i] + w[5] * f[i]) + (w[6] * g[i] + w[7] * h[i]));
}

static float dot(const float *w, const float *in, int taps)
{
	float lane[LANES] = { 0 }, sum = 0;
	for (int k = 0; k < taps; k += LANES)
		for (int i = 0; i < LANES; ++i)
			lane[i] += w[k + i] * in[k + i];
	for (int i = 0; i < LANES; ++i)
		sum += lane[i];
	return sum;
}

void downsample(const Polyphase *phase, const float *fine, ptrdiff_t fine_stride, int width,
	int height, float *scratch, float *out, ptrdiff_t out_stride)
{
	const int columns = FOLD * width, rows = FOLD * height;
	const int before = (phase->taps - FOLD) / 2;
	const float *zeros = scratch + columns + MOST_TAPS;
	float *row = scratch + MOST_TAPS / 2;
	for (int j = 0; j < height; ++j, out += out_stride) {
		memset(row, 0, (size_t)columns * sizeof *row);
		for (int k = 0; k < phase->taps; k += ROWS) {
			const float *in[ROWS];
			for (int r = 0; r < ROWS; ++r) {
				const int y = FOLD * j - before + k + r;
				in[r] = y < 0 || y >= rows ? zeros : fine + y * fine_stride;
			}
			add_rows(phase->weight + k, in, columns, row);
		}
		for (int i = 0; i < width; ++i)
			out[i] = dot(phase->weight, row + FOLD * i - before, phase->taps);
	}
}

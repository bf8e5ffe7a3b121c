/* edgewise_raster_sweep_template.h - pixels from the difference image by vectors; included by
 * edgewise_raster_targets.h once per instruction set; that file says what the parameters are.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

/* Spelled out, or compilers keep the sums in memory. */
#define EW_CLEAR_SUM(k) \
	if (k < ints) \
		sum[k] = EW_ZERO_INTS;
#define EW_ADD_SUM(k) \
	if (k < ints) \
		sum[k] = EW_ADD_INTS(sum[k], EW_LOAD_INTS(from + (k) * EW_INT_LANES));
#define EW_CLEAR_FROM(k) \
	if (k < ints) \
		EW_STORE_INTS(from + (k) * EW_INT_LANES, EW_ZERO_INTS);
#define EW_KEEP_SUM(k) \
	if (k < ints) \
		EW_STORE_INTS(carry + (k) * EW_INT_LANES, sum[k]);
#define EW_PUT_SUM(k) \
	if (k < ints) \
		EW_PUT_FLOATS(to + (k) * EW_INT_LANES, sum[k]);
#define EW_PUT_GROUP(k) \
	if ((k) * EW_GROUP_INTS < ints) \
		EW_PUT_BYTES(to + (k) * 16, sum + (k) * EW_GROUP_INTS);

/* 16, 32 or 64 columns of pixels; `count` less than 16: so many, written row by row. In bands, rows
 * that nothing touched are those above, and sums are cleared for the next band. */
#define EW_COLUMNS(stem, type, prepare, put) \
EW_ATTRIBUTE EW_INLINE void EW_ISA(stem##_strip)(const ew_raster_image *image, int column, \
	type *pixels, int columns, size_t count, int rows, ptrdiff_t stride, int banded) \
{ \
	const int ints = columns / 16 * EW_GROUP_INTS; \
	int32_t *const carry = image->sum + image->size + column, *from = carry; \
	const uint64_t *touched = image->touched; \
	const uint64_t bit = banded ? (uint64_t)1 << (column >> image->block) : 0; \
	EW_INTS sum[4 * EW_GROUP_INTS]; \
	type part[64 / sizeof(type)], *to; \
	prepare \
	EW_EACH_OF_STRIP(EW_CLEAR_SUM) \
	for (size_t j = 0; j < image->above; ++j, from += image->stride) { \
		EW_EACH_OF_STRIP(EW_ADD_SUM) \
	} \
	touched += banded ? image->above : 0; \
	for (int j = 0; j < rows; ++j, from += image->stride, pixels += stride) { \
		to = count ? part : pixels; \
		if (banded && columns == EW_STRIP && j && !(touched[j] & bit)) { \
			memcpy(to, to - stride, EW_STRIP * sizeof *to); \
			continue; \
		} \
		EW_EACH_OF_STRIP(EW_ADD_SUM) \
		put \
		if (banded) { \
			EW_EACH_OF_STRIP(EW_CLEAR_FROM) \
		} \
		if (count) \
			ew_raster_put(pixels, part, count * sizeof *part); \
	} \
	if (banded) { \
		EW_EACH_OF_STRIP(EW_KEEP_SUM) \
	} \
} \
EW_ATTRIBUTE EW_INLINE void EW_ISA(stem##_strips)(const ew_raster_image *image, type *pixels, \
	int rows, ptrdiff_t stride, int banded) \
{ \
	const int width = image->width; \
	int i = 0; \
	for (; i + EW_STRIP <= width; i += EW_STRIP) \
		EW_ISA(stem##_strip)(image, i, pixels + i, EW_STRIP, 0, rows, stride, banded); \
	for (; i + 32 <= width; i += 32) \
		EW_ISA(stem##_strip)(image, i, pixels + i, 32, 0, rows, stride, banded); \
	for (; i + 16 <= width; i += 16) \
		EW_ISA(stem##_strip)(image, i, pixels + i, 16, 0, rows, stride, banded); \
	if (i < width && (banded || width < 16)) \
		EW_ISA(stem##_strip)(image, i, pixels + i, 16, (size_t)(width - i), rows, stride, \
			banded); \
	else if (i < width)            /* some columns twice */ \
		EW_ISA(stem##_strip)(image, width - 16, pixels + width - 16, 16, 0, rows, stride, \
			banded); \
} \
EW_ATTRIBUTE static void EW_ISA(stem)(const ew_raster_image *image, type *pixels, int rows, \
	ptrdiff_t stride) \
{ \
	if (image->touched) \
		EW_ISA(stem##_strips)(image, pixels, rows, stride, 1); \
	else \
		EW_ISA(stem##_strips)(image, pixels, rows, stride, 0); \
}
EW_COLUMNS(floats, float, const EW_FLOATS_TYPE unit = EW_SPLAT_FLOAT(image->unit);,
	EW_EACH_OF_STRIP(EW_PUT_SUM))
EW_COLUMNS(bytes, unsigned char, ,
	EW_PUT_GROUP(0) EW_PUT_GROUP(1) EW_PUT_GROUP(2) EW_PUT_GROUP(3))

#undef EW_COLUMNS
#undef EW_CLEAR_SUM
#undef EW_ADD_SUM
#undef EW_CLEAR_FROM
#undef EW_KEEP_SUM
#undef EW_PUT_SUM
#undef EW_PUT_GROUP
#undef EW_ISA
#undef EW_ATTRIBUTE
#undef EW_INTS
#undef EW_INT_LANES
#undef EW_GROUP_INTS
#undef EW_EACH_OF_STRIP
#undef EW_ZERO_INTS
#undef EW_LOAD_INTS
#undef EW_STORE_INTS
#undef EW_ADD_INTS
#undef EW_FLOATS_TYPE
#undef EW_SPLAT_FLOAT
#undef EW_PUT_FLOATS
#undef EW_PUT_BYTES

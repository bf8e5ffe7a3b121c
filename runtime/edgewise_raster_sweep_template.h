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
#define EW_MOVE_SUM(k) \
	if (k < ints) { \
		sum[k] = EW_ADD_INTS(EW_LOAD_INTS(carry + (k) * EW_INT_LANES), \
			EW_LOAD_INTS(from + (k) * EW_INT_LANES)); \
		EW_STORE_INTS(carry + (k) * EW_INT_LANES, sum[k]); \
		EW_STORE_INTS(from + (k) * EW_INT_LANES, EW_ZERO_INTS); \
	}
#define EW_PUT_SUM(k) \
	if (k < ints) \
		EW_PUT_FLOATS(to + (k) * EW_INT_LANES, sum[k]);
#define EW_PUT_GROUP(k) \
	if ((k) * EW_GROUP_INTS < ints) \
		EW_PUT_BYTES(to + (k) * 16, sum + (k) * EW_GROUP_INTS);

/* Runs over `end - i` columns by 64, 32 and 16 of them, and over the rest. */
#define EW_BY_STRIPS(i, end, strip, rest) \
	for (; i + EW_STRIP <= end; i += EW_STRIP) \
		strip(EW_STRIP) \
	for (; i + 32 <= end; i += 32) \
		strip(32) \
	for (; i + 16 <= end; i += 16) \
		strip(16) \
	if (i < end) \
		rest

/* A small image column by column: 16, 32 or 64 columns of pixels down all rows; `count` less than
 * 16: so many, written row by row.
 *
 * A band of a large one row by row, the sums in the first row of the difference image: what nothing
 * touched is what stands above, and rows are cleared for the next band. */
#define EW_COLUMNS(stem, type, prepare, put) \
EW_ATTRIBUTE EW_INLINE void EW_ISA(stem##_strip)(const ew_raster_image *image, int column, \
	type *pixels, int columns, size_t count, int rows, ptrdiff_t stride) \
{ \
	const int ints = columns / 16 * EW_GROUP_INTS; \
	const int32_t *from = image->sum + image->size + column; \
	EW_INTS sum[4 * EW_GROUP_INTS]; \
	type part[64 / sizeof(type)]; \
	prepare \
	EW_EACH_OF_STRIP(EW_CLEAR_SUM) \
	for (size_t j = 0; j < image->above; ++j, from += image->stride) { \
		EW_EACH_OF_STRIP(EW_ADD_SUM) \
	} \
	for (int j = 0; j < rows; ++j, from += image->stride, pixels += stride) { \
		type *const to = count ? part : pixels; \
		EW_EACH_OF_STRIP(EW_ADD_SUM) \
		put \
		if (count) \
			ew_raster_put(pixels, part, count * sizeof *part); \
	} \
} \
EW_ATTRIBUTE EW_INLINE void EW_ISA(stem##_strips)(const ew_raster_image *image, type *pixels, \
	int rows, ptrdiff_t stride) \
{ \
	const int width = image->width; \
	int i = 0; \
	EW_BY_STRIPS(i, width, EW_WHOLE_STRIP(stem), { \
		const int at = width < 16 ? i : width - 16;        /* some columns twice */ \
		EW_ISA(stem##_strip)(image, at, pixels + at, 16, width < 16 ? (size_t)width : 0, \
			rows, stride); \
	}) \
} \
EW_ATTRIBUTE EW_INLINE void EW_ISA(stem##_piece)(const ew_raster_image *image, int32_t *carry, \
	int32_t *from, type *pixels, int columns, size_t count) \
{ \
	const int ints = columns / 16 * EW_GROUP_INTS; \
	EW_INTS sum[4 * EW_GROUP_INTS]; \
	type part[64 / sizeof(type)], *const to = count ? part : pixels; \
	prepare \
	(void)image; \
	EW_EACH_OF_STRIP(EW_MOVE_SUM) \
	put \
	if (count) \
		ew_raster_put(pixels, part, count * sizeof *part); \
} \
EW_ATTRIBUTE static void EW_ISA(stem##_band)(const ew_raster_image *image, type *pixels, int rows, \
	ptrdiff_t stride) \
{ \
	const int width = image->width; \
	int32_t *const carry = image->sum + image->size, *from = carry; \
	for (size_t j = 1; j < image->above; ++j) { \
		from += image->stride; \
		for (int i = 0; i < width; ++i) { \
			ew_raster_add(carry + i, from[i]); \
			from[i] = 0; \
		} \
	} \
	for (int j = 0; j < rows; ++j, pixels += stride) { \
		const uint64_t touched = j ? image->touched[image->above + (size_t)j] : ~(uint64_t)0; \
		from += image->stride; \
		for (int i = 0; i < width; ) { \
			const int end = ew_raster_run(image, touched, i); \
			if (touched >> (i >> image->block) & 1) { \
				EW_BY_STRIPS(i, end, EW_PIECE_OF_ROW(stem), \
					EW_ISA(stem##_piece)(image, carry + i, from + i, pixels + i, \
						16, (size_t)(end - i));) \
			} else { \
				memcpy(pixels + i, pixels + i - stride, \
					(size_t)(end - i) * sizeof *pixels); \
			} \
			i = end; \
		} \
	} \
} \
EW_ATTRIBUTE static void EW_ISA(stem)(const ew_raster_image *image, type *pixels, int rows, \
	ptrdiff_t stride) \
{ \
	if (image->touched) \
		EW_ISA(stem##_band)(image, pixels, rows, stride); \
	else \
		EW_ISA(stem##_strips)(image, pixels, rows, stride); \
}
#define EW_WHOLE_STRIP(stem) EW_WHOLE_STRIP_##stem
#define EW_WHOLE_STRIP_floats(columns) \
	EW_ISA(floats_strip)(image, i, pixels + i, columns, 0, rows, stride);
#define EW_WHOLE_STRIP_bytes(columns) \
	EW_ISA(bytes_strip)(image, i, pixels + i, columns, 0, rows, stride);
#define EW_PIECE_OF_ROW(stem) EW_PIECE_OF_ROW_##stem
#define EW_PIECE_OF_ROW_floats(columns) \
	EW_ISA(floats_piece)(image, carry + i, from + i, pixels + i, columns, 0);
#define EW_PIECE_OF_ROW_bytes(columns) \
	EW_ISA(bytes_piece)(image, carry + i, from + i, pixels + i, columns, 0);
EW_COLUMNS(floats, float, const EW_FLOATS_TYPE unit = EW_SPLAT_FLOAT(image->unit);,
	EW_EACH_OF_STRIP(EW_PUT_SUM))
EW_COLUMNS(bytes, unsigned char, ,
	EW_PUT_GROUP(0) EW_PUT_GROUP(1) EW_PUT_GROUP(2) EW_PUT_GROUP(3))

#undef EW_BY_STRIPS
#undef EW_WHOLE_STRIP
#undef EW_WHOLE_STRIP_floats
#undef EW_WHOLE_STRIP_bytes
#undef EW_PIECE_OF_ROW
#undef EW_PIECE_OF_ROW_floats
#undef EW_PIECE_OF_ROW_bytes
#undef EW_COLUMNS
#undef EW_CLEAR_SUM
#undef EW_ADD_SUM
#undef EW_MOVE_SUM
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

/* vector_template.h - the limits of the machine at one vector width and precision; included by
 * vectors.c once for each.
 *
 * Parameters: WIDTH_REAL; WIDTH_VECTOR, a vector of them that may lie anywhere in memory;
 * WIDTH_NAME(stem); WIDTH_ATTRIBUTE, the target; WIDTH_FMA(a, b, c); WIDTH_STREAM(p, v), a store
 * past the caches, left out where there is none. Loops are unrolled by hand, with as many
 * independent chains as it takes to fill two pipes of latency five, or to keep loads in flight. */

#ifndef WIDTH_STREAM
#define WIDTH_STREAM(p, v) (*(WIDTH_VECTOR *)(p) = (v))
#endif
#define WIDTH_LANES (sizeof(WIDTH_VECTOR) / sizeof(WIDTH_REAL))
#define WIDTH_CHAINS(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11)
#define WIDTH_EIGHT(X) X(x, 0) X(x, 1) X(x, 2) X(x, 3) X(y, 0) X(y, 1) X(y, 2) X(y, 3)

WIDTH_ATTRIBUTE static void WIDTH_NAME(peak)(const void *context, long repeat)
{
	(void)context;
	static volatile WIDTH_REAL start = 1, sink;
	const WIDTH_VECTOR one = (WIDTH_VECTOR){ 0 } + start;
	const WIDTH_VECTOR factor = one * (WIDTH_REAL)0.999, term = one * (WIDTH_REAL)0.001;
#define WIDTH_OPEN(k) WIDTH_VECTOR c##k = one * (WIDTH_REAL)(k);
#define WIDTH_STEP(k) c##k = WIDTH_FMA(c##k, factor, term);
#define WIDTH_CLOSE(k) c##k +
	WIDTH_CHAINS(WIDTH_OPEN)
	for (long i = 0; i < repeat * (PEAK_WORK / 12); ++i) {
		WIDTH_CHAINS(WIDTH_STEP)
	}
	const WIDTH_VECTOR sum = WIDTH_CHAINS(WIDTH_CLOSE) one;
	WIDTH_REAL lane[WIDTH_LANES];
	memcpy(lane, &sum, sizeof sum);
	sink = lane[0];
	(void)sink;
#undef WIDTH_OPEN
#undef WIDTH_STEP
#undef WIDTH_CLOSE
}

/* Without y the blocks of one array are taken in turn for both. */
WIDTH_ATTRIBUTE static WIDTH_VECTOR WIDTH_NAME(sum)(const WIDTH_REAL *x, const WIDTH_REAL *y,
	size_t n)
{
#define WIDTH_OPEN(array, k) WIDTH_VECTOR array##k = { 0 };
#define WIDTH_STEP(array, k) array##k += \
	*(const WIDTH_VECTOR *)(array + i * stride + (k) * WIDTH_LANES);
#define WIDTH_CLOSE(array, k) array##k +
	const size_t block = READ_BLOCK * WIDTH_LANES, stride = y ? 1 : 2;
	size_t i = 0;
	WIDTH_REAL rest = 0;
	WIDTH_EIGHT(WIDTH_OPEN)
	y = y ? y : x + block;
	for (; i + block <= n; i += block) {
		WIDTH_EIGHT(WIDTH_STEP)
	}
	for (; i < n; ++i)
		rest += x[i * stride] + (stride == 1 ? y : x + 1)[i * stride];
	return WIDTH_EIGHT(WIDTH_CLOSE) (WIDTH_VECTOR){ 0 } + rest;
#undef WIDTH_OPEN
#undef WIDTH_STEP
#undef WIDTH_CLOSE
}

WIDTH_ATTRIBUTE static void WIDTH_NAME(read)(const void *x, const void *y, size_t n)
{
	static volatile WIDTH_REAL sink;
	WIDTH_REAL lane[WIDTH_LANES];
	const WIDTH_VECTOR sum = WIDTH_NAME(sum)(x, y, n);
	memcpy(lane, &sum, sizeof sum);
	sink = lane[0];
	(void)sink;
}

WIDTH_ATTRIBUTE static void WIDTH_NAME(fill)(const void *x, const void *y,
	const int32_t *offsets, size_t rings, void *out, size_t outputs, int stream)
{
	WIDTH_REAL *place = out;
	for (size_t ring = 0; ring < rings; ring += FILL_BLOCK) {
		size_t count = rings - ring < FILL_BLOCK ? rings - ring : FILL_BLOCK;
		size_t first = (size_t)offsets[ring];
		int32_t touched = 0;
		for (size_t k = 0; k < count; k += 16)         /* each cache line of offsets */
			touched += offsets[ring + k] & 1;
		WIDTH_VECTOR value = WIDTH_NAME(sum)((const WIDTH_REAL *)x + first,
			(const WIDTH_REAL *)y + first, (size_t)offsets[ring + count] - first);
		value += (WIDTH_REAL)touched;
		size_t k = 0;
		for (; stream && k + WIDTH_LANES <= count * outputs; k += WIDTH_LANES)
			WIDTH_STREAM(place + k, value);
		for (; k + WIDTH_LANES <= count * outputs; k += WIDTH_LANES)
			*(WIDTH_VECTOR *)(place + k) = value;
		for (; k < count * outputs; ++k)
			place[k] = 0;
		place += count * outputs;
	}
}

#undef WIDTH_LANES
#undef WIDTH_CHAINS
#undef WIDTH_EIGHT
#undef WIDTH_REAL
#undef WIDTH_VECTOR
#undef WIDTH_NAME
#undef WIDTH_ATTRIBUTE
#undef WIDTH_FMA
#undef WIDTH_STREAM

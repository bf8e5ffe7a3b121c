/* edgewise_sides_template.h - rings side by side, transposed and summed up in registers; included
 * by edgewise_columns_template.h once per low degree, and once more for the centroid.
 *
 * EW_SIDE is the name of the function, EW_SUMS counts its accumulators, and EW_NEXT(k) takes column
 * k of a block: vertex j of every ring, in (vx, vy), behind (px, py) and qy before that; with
 * EW_MOVED, less the first vertex of the ring. The rings begin with their first vertex repeated and
 * end with it twice, which adds 0 and closes them; with two turns the parity of j is that of k.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

EW_ATTRIBUTE static void EW_SIDE(const EW_REAL *x, const EW_REAL *y, const ew_ring_lanes *lanes,
	const EW_REAL *lengths, EW_REAL *sum)
{
	const int32_t *s = lanes->start;
	const size_t start[EW_ROWS] = EW_STARTS(s), shortest = lanes->shortest;
	const size_t longest = lanes->longest;
	EW_VECTOR bx[EW_COLUMNS], by[EW_COLUMNS], acc[EW_SUMS], left, fx, fy, cx, px, py, qy, vx, vy;
	size_t c = 0;
	EW_ISA(block)(x, start, bx);
	EW_ISA(block)(y, start, by);
	fx = bx[0];
	fy = by[0];
	cx = px = EW_MOVED ? EW_SUB(fx, fx) : fx;
	py = qy = EW_MOVED ? EW_SUB(fy, fy) : fy;
	for (int k = 0; k < EW_SUMS; ++k)
		acc[k] = EW_SPLAT(0);
#define EW_TAKE(k, value_x, value_y) \
	vx = value_x; \
	vy = value_y; \
	vx = EW_MOVED ? EW_SUB(vx, fx) : vx; \
	vy = EW_MOVED ? EW_SUB(vy, fy) : vy; \
	EW_NEXT(k); \
	px = vx; \
	qy = py; \
	py = vy;
#define EW_WHOLE(k) EW_TAKE(k, bx[k], by[k])
#define EW_PART(k) EW_TAKE(k, EW_SELECT(left, EW_SPLAT(k), bx[k], fx), \
	EW_SELECT(left, EW_SPLAT(k), by[k], fy))
	for (; c + EW_COLUMNS <= shortest; c += EW_COLUMNS) {
		EW_ISA(block)(x + c, start, bx);
		EW_ISA(block)(y + c, start, by);
		EW_EACH(EW_WHOLE)
	}
	left = shortest < longest ? EW_LOAD(lengths) : EW_SPLAT((EW_REAL)longest);
	for (left = EW_SUB(left, EW_SPLAT((EW_REAL)c)); c < longest; c += EW_COLUMNS) {
		EW_ISA(block)(x + c, start, bx);
		EW_ISA(block)(y + c, start, by);
		EW_EACH(EW_PART)
		left = EW_SUB(left, EW_SPLAT(EW_COLUMNS));
	}
	EW_TAKE(0, fx, fy)
	EW_TAKE(1, fx, fy)
#undef EW_TAKE
#undef EW_WHOLE
#undef EW_PART
	(void)qy;
	for (int k = 0; k < EW_SUMS; ++k)
		EW_STORE(sum + k * EW_WIDTH, acc[k]);
}

#undef EW_SIDE
#undef EW_SUMS
#undef EW_NEXT
#undef EW_MOVED

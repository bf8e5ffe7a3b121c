/* edgewise_sides_template.h - rings side by side, transposed and summed up in registers; included
 * by edgewise_columns_template.h once per low degree, and once more for the centroid.
 *
 * EW_SIDE(stem) names what belongs to the degree, EW_SUMS counts its accumulators, and EW_NEXT(k)
 * takes column k of a block: vertex j of every ring, in (vx, vy), behind (px, py) and qy before
 * that; with EW_MOVED, less the first vertex of the ring. With two turns the parity of j is that of
 * k. A ring begins with its first vertex repeated, so that with EW_IDLE vertex 1 adds 0, and goes
 * on with it behind its last one, which closes the ring and then adds 0. Nothing but sums goes
 * through memory: a group is some 100 cycles.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

/* Spelled out, and nothing but inline functions see the accumulators: compilers keep in memory what
 * a loop goes over and what a pointer leads to. */
#define EW_EACH_SUM(X) X(0) X(1) X(2) X(3) X(4) X(5)
#define EW_CLEAR_SUM(k) \
	if (k < EW_SUMS) \
		acc[k] = EW_SPLAT(0);
#define EW_COPY_SUM(k) acc[k] = any[k];
#define EW_PUT_SUM(k) \
	if (k < EW_SUMS + 2 * EW_MOVED) { \
		EW_STORE_WIDE(sum + k * EW_ROW + done, acc[k]); \
		off = EW_ADD(off, EW_SUB(acc[k], acc[k])); \
	}
#define EW_LOAD_BLOCK \
	EW_ISA(block)(x, start, bx); \
	EW_ISA(block)(y, start, by);
/* Hidden, or compilers keep a pointer to every row of x and of y. */
#define EW_NEXT_BLOCK \
	x += EW_COLUMNS; \
	y += EW_COLUMNS; \
	EW_HIDE(x); \
	EW_HIDE(y); \
	EW_LOAD_BLOCK
#define EW_SEE(value_x, value_y) \
	vx = EW_MOVED ? EW_SUB(value_x, fx) : value_x; \
	vy = EW_MOVED ? EW_SUB(value_y, fy) : value_y;
#define EW_PASS \
	px = vx; \
	qy = py; \
	py = vy;
#define EW_TAKE(k, value_x, value_y) \
	EW_SEE(value_x, value_y) \
	EW_NEXT(k); \
	EW_PASS
/* An edge to the origin adds nothing. */
#define EW_CLOSE(k) \
	if (!EW_MOVED) { \
		EW_TAKE(k, fx, fy) \
	}
#define EW_WHOLE(k) EW_TAKE(k, bx[k], by[k])
#define EW_PART(k) EW_TAKE(k, EW_SELECT(length, EW_SPLAT(k), bx[k], fx), \
	EW_SELECT(length, EW_SPLAT(k), by[k], fy))
#define EW_TAIL(k) \
	if (c + k < longest) { \
		EW_WHOLE(k) \
	} else if (c + k == longest) { \
		EW_CLOSE(k) \
	}

/* One group, whose rings have three vertices at least and `longest` at most, or, if they are the
 * same, all that many; then `length` does not matter. */
EW_ATTRIBUTE EW_INLINE void EW_SIDE(sum)(const EW_REAL *x, const EW_REAL *y, const size_t *start,
	int same, size_t longest, EW_VECTOR length, EW_VECTOR *acc)
{
	EW_VECTOR bx[EW_COLUMNS], by[EW_COLUMNS], fx, fy, cx, px, py, qy, vx, vy;
	size_t c = 0;
	EW_LOAD_BLOCK
	fx = bx[0];
	fy = by[0];
	cx = px = EW_MOVED ? EW_SUB(fx, fx) : fx;
	py = qy = EW_MOVED ? EW_SUB(fy, fy) : fy;
	EW_EACH_SUM(EW_CLEAR_SUM)
	if (EW_IDLE) {
		EW_SEE(bx[1], by[1])
		EW_PASS
	} else {
		EW_WHOLE(1)
	}
	if (same) {
		EW_MORE(EW_TAIL)
		for (c = EW_COLUMNS; c + EW_COLUMNS <= longest; c += EW_COLUMNS) {
			EW_NEXT_BLOCK
			EW_EACH(EW_WHOLE)
		}
		if (c == longest) {
			EW_CLOSE(0)
		} else if (c < longest) {
			EW_NEXT_BLOCK
			EW_EACH(EW_TAIL)
		}
	} else {
		EW_MORE(EW_PART)
		for (c = EW_COLUMNS; c < longest; c += EW_COLUMNS) {
			length = EW_SUB(length, EW_SPLAT(EW_COLUMNS));
			EW_NEXT_BLOCK
			EW_EACH(EW_PART)
		}
		EW_CLOSE(0)
	}
	(void)qy;
#if EW_MOVED
	acc[EW_SUMS] = fx;
	acc[EW_SUMS + 1] = fy;
#endif
}

/* The same with rings that do not fit. */
EW_ATTRIBUTE static void EW_SIDE(sum_any)(const EW_REAL *x, const EW_REAL *y,
	const int32_t *offsets, EW_VECTOR *acc)
{
	EW_LOCAL(lanes) lanes;
	EW_LOCAL(fit)(x, y, offsets, EW_ROWS, EW_ROWS, &lanes);
	for (int k = 0; k < EW_SIDE_SUMS; ++k)
		acc[k] = EW_SPLAT(0);
	const size_t start[EW_ROWS] = { EW_STARTS(lanes.start) };
	const EW_VECTOR length = EW_LOAD(lanes.length);
	if (lanes.longest)
		EW_SIDE(sum)(x, y, start, 0, lanes.longest, length, acc);
	acc[0] = EW_SELECT(length, EW_SPLAT(0), acc[0], EW_SPLAT((EW_REAL)NAN));
}

EW_ATTRIBUTE static size_t EW_SIDE(side)(const EW_REAL *x, const EW_REAL *y,
	const int32_t *offsets, size_t rings, size_t vertices, double *sum, int *not_finite)
{
	EW_VECTOR acc[EW_SIDE_SUMS], off = EW_SPLAT(0);
	size_t done = 0;
	for (; done + EW_ROWS <= rings; done += EW_ROWS) {
		const int32_t *s = offsets + done;
		const EW_COUNTS over = EW_OVER(s);             /* vertices, less three */
		const int32_t first = s[1] - s[0] - 3;
		const int same = EW_SAME(over, first);
		const uint32_t most = same ? (uint32_t)first : EW_MOST(over);
		const size_t longest = most < EW_SHORT - 3 ? most + 3 : (size_t)EW_SHORT;
		const size_t start[EW_ROWS] = { EW_STARTS(s) };
		if ((size_t)s[EW_ROWS - 1] + longest + 3 > vertices)
			break;
		if (longest == EW_SHORT) {
			EW_VECTOR any[EW_SIDE_SUMS];
			EW_SIDE(sum_any)(x, y, s, any);
			EW_EACH_SUM(EW_COPY_SUM)
		} else if (same) {
			EW_SIDE(sum)(x, y, start, 1, longest, off, acc);
		} else {
			EW_SIDE(sum)(x, y, start, 0, longest,
				EW_ADD(EW_LENGTHS(over), EW_SPLAT(3)), acc);
		}
		EW_EACH_SUM(EW_PUT_SUM)
	}
	*not_finite = !EW_ISA(is_zero)(off);
	return done;
}

#undef EW_LOAD_BLOCK
#undef EW_NEXT_BLOCK
#undef EW_SEE
#undef EW_PASS
#undef EW_TAKE
#undef EW_CLOSE
#undef EW_WHOLE
#undef EW_PART
#undef EW_TAIL
#undef EW_EACH_SUM
#undef EW_CLEAR_SUM
#undef EW_COPY_SUM
#undef EW_PUT_SUM
#undef EW_SIDE
#undef EW_SUMS
#undef EW_NEXT
#undef EW_MOVED
#undef EW_IDLE

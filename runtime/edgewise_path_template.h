/* edgewise_path_template.h - the reader of paths, for whoever takes their edges; included once per
 * reader and precision.
 *
 * EW_READ the name of the function; EW_READ_HAS(verb): is it one of ours; EW_READER the type of
 * what takes edges; EW_READ_EDGE(reader, verb, here, next, weight) takes one from `here` on with
 * its further points at `next`; EW_READ_CLOSING(reader, here, start) what closes a contour.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

/* 0 if the verbs do not take exactly these points and weights, or are not ours. The first one is
 * a move. */
static int EW_READ(EW_READER *e, const unsigned char *verbs, size_t verb_count,
	const EW_REAL *points, size_t point_count, const EW_REAL *weights, size_t weight_count)
{
	const EW_REAL *start = points, *here = points, *next = points;
	for (size_t i = 0; i < verb_count; ++i) {
		const int verb = verbs[i];
		if (!EW_READ_HAS(verb) || ew_path_points(verb) > point_count
		    || (verb == EW_CONIC && weight_count == 0))
			return 0;
		point_count -= ew_path_points(verb);
		if (verb == EW_MOVE || verb == EW_CLOSE) {
			EW_READ_CLOSING(e, here, start);
			start = verb == EW_MOVE ? next : start;
			next += 2 * ew_path_points(verb);
			here = start;
			continue;
		}
		EW_READ_EDGE(e, verb, here, next, weights);
		if (verb == EW_CONIC) {
			++weights;
			--weight_count;
		}
		next += 2 * ew_path_points(verb);
		here = next - 2;
	}
	if (verb_count)
		EW_READ_CLOSING(e, here, start);
	return point_count == 0 && weight_count == 0;
}

#undef EW_READ
#undef EW_READER
#undef EW_READ_HAS
#undef EW_READ_EDGE
#undef EW_READ_CLOSING

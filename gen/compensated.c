/* compensated.c - the area as if it were summed in twice the precision.
 *
 * Every product is split into its rounded value and its rounding error, every sum likewise, and
 * the errors go to an accumulator of their own (Dot2: Ogita, Rump, Oishi 2005; TwoSum: Knuth). In
 * exact arithmetic all errors are 0, so the proof is the usual one; what keeps them in floating
 * point is that nothing reassociates. The order of operations is that of the definition of TwoSum;
 * fuse.c turns ERROR into one fused operation. */
#include "gen.h"

typedef struct { Ref sum, error; } TwoSum;

/* sum = fl(a +- b), and exactly what it lacks. */
static TwoSum two_sum(Dag *dag, Ref a, Ref b, int subtract)
{
	Ref sum = subtract ? dag_sub(dag, a, b) : dag_add(dag, a, b);
	Ref part = dag_sub(dag, sum, a);             /* of sum, what came from b */
	Ref lost_a = dag_sub(dag, a, dag_sub(dag, sum, part));
	Ref lost_b = subtract ? dag_add(dag, b, part) : dag_sub(dag, b, part);
	Ref lost = subtract ? dag_sub(dag, lost_a, lost_b) : dag_add(dag, lost_a, lost_b);
	return (TwoSum){ sum, lost };
}

/* Accumulators: the sum of x0 y1 - x1 y0, and of all that rounding took from it. */
Dag *compensated_area(void)
{
	Dag *dag = dag_new("dot2");
	Leaves end = ends(dag);
	Ref x0 = end.ref[VAR_X0], y0 = end.ref[VAR_Y0], x1 = end.ref[VAR_X1], y1 = end.ref[VAR_Y1];
	Ref left = dag_name(dag, dag_mul(dag, x0, y1), "left");
	Ref right = dag_name(dag, dag_mul(dag, x1, y0), "right");
	Ref left_error = dag_node(dag, OP_ERROR, x0, y1, left);
	Ref right_error = dag_node(dag, OP_ERROR, x1, y0, right);
	TwoSum first = two_sum(dag, dag_accumulator(dag, 0), left, 0);
	TwoSum second = two_sum(dag, first.sum, right, 1);
	Ref products = dag_sub(dag, left_error, right_error);
	Ref sums = dag_add(dag, first.error, second.error);
	dag_out(dag, second.sum);
	dag_accumulate(dag, dag_add(dag, products, sums));
	dag->finish = allocate(sizeof *dag->finish);
	dag->finish[0] = poly_add(poly_mono(rat(1, 2), mono_accumulator(0)),
		poly_mono(rat(1, 2), mono_accumulator(1)));
	dag->finishes = 1;
	return dag;
}

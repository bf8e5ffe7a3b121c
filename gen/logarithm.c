/* logarithm.c - the logarithm as operations, for the programs that are not polynomial.
 *
 * z >= 1 is split into 2^k m with m in [sqrt 1/2, sqrt 2), v = (m-1)/(m+1) is at most 3 - 2 sqrt 2,
 * and with K(tau) = (atanh(sqrt tau)/sqrt tau - 1)/tau, a short polynomial there,
 *
 *     1/2 log z = k ln2/2 + v + v^3 K(v^2) = atanh((z-1)/(z+1))
 *
 * No branch, no table, and the same bits wherever the operations give the same bits. */
#include "gen.h"

Ref series_value(Dag *dag, Series series, Ref x)
{
	Ref sum = dag_const(dag, series.coef[series.count - 1]);
	for (int i = series.count - 2; i >= 0; --i) {
		Ref coef = dag_const(dag, series.coef[i]);
		sum = dag_add(dag, coef, dag_mul(dag, sum, x));
	}
	return sum;
}

Logarithm logarithm(Dag *dag, int is_float, Ref z, Ref tau)
{
	Logarithm log;
	Ref one = dag_const(dag, rat(1, 1));
	Ref m = dag_name(dag, dag_unary(dag, OP_FRACTION, z), "m");
	log.k = dag_name(dag, dag_unary(dag, OP_EXPONENT, z), "k");
	Ref below = dag_sub(dag, m, one), above = dag_add(dag, m, one);
	Ref v = dag_name(dag, dag_div(dag, below, above), "v");
	Ref vv = dag_name(dag, dag_mul(dag, v, v), "vv");
	Ref x = tau == NONE ? vv : dag_choose(dag, log.k, vv, tau);
	log.series = dag_name(dag, series_value(dag, series_atanh(is_float), x), "series");
	Ref tail = dag_add(dag, v, dag_mul(dag, dag_mul(dag, v, vv), log.series));
	Ref whole = dag_mul(dag, log.k, dag_const(dag, number(NUMBER_HALF_LN2)));
	log.half = dag_name(dag, dag_add(dag, tail, whole), "half");
	return log;
}

/* kernel.c - the list of kernels of a request, each built, proven and bounded;
 * the pipeline in two short functions.
 *
 * Precisions share a program: only constants and the name of the type differ. Targets without FMA
 * run the portable program, the others the fused one. The finish program of a ring is the same
 * for all. */
#include "gen.h"

/* p polynomials, d dag, f fused, s schedule */
typedef struct { const char *letters; Text *text; } Dump;

static int wants(const Dump *dump, char letter)
{
	for (const char *p = dump->letters; p && *p; ++p)
		if (*p == letter)
			return 1;
	return 0;
}

static void dump_polynomials(const Dump *dump, const char *name, const Integral *want, int count)
{
	if (!wants(dump, 'p'))
		return;
	for (int j = 0; j < count; ++j)
		text_add(dump->text, "%s: polynomial %d\n  %s\n", name, j,
			poly_text(want[j].value, " "));
}

static void dump_dag(const Dump *dump, char letter, const char *name, const Dag *dag)
{
	if (!wants(dump, letter))
		return;
	text_add(dump->text, "%s: %s, scheme %s\n", name, letter == 'd' ? "dag" : "fused",
		dag->scheme);
	dag_dump(dump->text, dag);
	for (int j = 0; j < dag->finishes; ++j)
		text_add(dump->text, "  finish %d = %s\n", j, poly_text(dag->finish[j], " "));
}

static Program scheduled(const Dump *dump, const char *name, const char *what, const Dag *dag,
	const Integral *want, int count)
{
	Program program = schedule(dag);
	prove_program(&program, want, count);
	if (wants(dump, 's')) {
		text_add(dump->text, "%s: schedule, %s\n", name, what);
		program_dump(dump->text, &program);
	}
	return program;
}

static Edge dumped_edge(const Integrand *what, const Dump *dump)
{
	Edge edge = { .what = what, .integral = green_line(what->integrand) };
	const char *name = format("line_%s", what->name);
	Dag *dag = scheme_edge(&edge.integral);
	dump_polynomials(dump, name, &edge.integral, 1);
	dump_dag(dump, 'd', name, dag);
	prove_dag(dag, &edge.integral, 1, "scheme");
	if (!dag_reverses(dag))
		bug("swapping the ends of the edge does not negate %s bit for bit", name);
	edge.program = scheduled(dump, name, "portable", dag, &edge.integral, 1);
	edge.bound = bound_edge(dag, &edge.integral);
	return edge;
}

Edge build_edge(const Integrand *what)
{
	const Dump silent = { NULL, NULL };
	return dumped_edge(what, &silent);
}

static void worsen(Bound *worst, Bound bound)
{
	worst->k = bound.k > worst->k ? bound.k : worst->k;
	worst->repeat = bound.repeat > worst->repeat ? bound.repeat : worst->repeat;
}

static void build_ring(Ring *ring, const Dag *dag, const Integral *want, const Dump *dump)
{
	dump_dag(dump, 'd', ring->name, dag);
	prove_dag(dag, want, ring->outputs, "scheme");
	Dag *fused = fuse(dag);
	dump_dag(dump, 'f', ring->name, fused);
	prove_dag(fused, want, ring->outputs, "fuse");
	ring->portable = scheduled(dump, ring->name, "portable", dag, want, ring->outputs);
	ring->fused = scheduled(dump, ring->name, "fma", fused, want, ring->outputs);
	Dag *finish = scheme_finish(dag);
	ring->finish = schedule(finish);
	prove_finish(&ring->finish, dag);
	ring->accumulators = dag->outs * dag->turns;
	ring->turns = dag->turns;
	ring->window = dag->window;
	ring->scheme = dag->scheme;
}

/* All but the compensated area, whose bound is not a number of roundings. */
static void build_bounded_ring(Ring *ring, const Dag *dag, const Integral *want, const Dump *dump)
{
	build_ring(ring, dag, want, dump);
	ring->bound = bound_ring(dag, ring->finish.dag, want, ring->outputs);
	for (int j = 0; j < ring->outputs; ++j)
		worsen(&ring->worst, ring->bound[j]);
}

static Ring *next_ring(Kernels *kernels, const char *name, const char *family, int m, int n,
	int outputs)
{
	Ring *ring = &kernels->ring[kernels->rings++];
	*ring = (Ring){ .name = name, .family = family, .m = m, .n = n, .outputs = outputs };
	return ring;
}

static void build_integrand(Kernels *all, const Integrand *what, const char *scheme,
	const Dump *dump)
{
	Edge edge = dumped_edge(what, dump);
	all->edge[all->edges++] = edge;
	const char *family = what->m < 0 ? "polynomial" : "monomial";
	Ring *ring = next_ring(all, what->name, family, what->m, what->n, 1);
	build_bounded_ring(ring, scheme_ring(&edge.integral, -1, scheme), &edge.integral, dump);
}

/* Moments come in the order of EW_INDEX,
 * so those of a lower degree are the first of those of a higher one. */
static Integral *all_integrals(const Request *request)
{
	int count = (request->moments + 1) * (request->moments + 2) / 2;
	Integral *want = allocate((size_t)(count + 1) * sizeof *want);
	for (int i = 0; i < count && request->moments >= 0; ++i)
		want[i] = green_line(request->monomial[i].integrand);
	return want;
}

/* All moments to each degree, the magnitudes that bound them, and the compensated area. */
static void build_families(Kernels *all, const Request *request, const Dump *dump,
	void (*progress)(int done, int of), int rings)
{
	Integral *want = all_integrals(request), *terms = all_integrals(request);
	for (int degree = 0; degree <= request->moments; ++degree) {
		const int outputs = (degree + 1) * (degree + 2) / 2;
		progress(all->rings, rings);
		build_bounded_ring(next_ring(all, format("moments_%d", degree), "moments", degree, 0,
			outputs), scheme_ring(want, degree, request->scheme), want, dump);
	}
	for (int j = 0; j < (request->moments + 1) * (request->moments + 2) / 2; ++j)
		terms[j].value = want[j].magnitude;
	for (int degree = 0; degree <= request->moments; ++degree) {
		const int outputs = (degree + 1) * (degree + 2) / 2;
		const Integral vertex = moments_vertex_magnitude();
		progress(all->rings, rings);
		build_bounded_ring(next_ring(all, format("magnitudes_%d", degree), "magnitudes", degree, 0,
			outputs), moments_magnitudes(degree), degree ? terms : &vertex, dump);
	}
	if (request->moments >= 0)
		build_ring(next_ring(all, "compensated", "compensated", 0, 0, 1),
			compensated_area(), want, dump);
}

Kernels build_kernels(const Request *request, void (*progress)(int done, int of),
	const char *letters, Text *text)
{
	const Dump dump = { letters, text };
	const int edges = request->monomials + request->polynomials;
	const int rings = edges + 2 * (request->moments + 1) + (request->moments >= 0);
	Kernels all = {
		allocate((size_t)edges * sizeof(Edge)), 0, allocate((size_t)rings * sizeof(Ring)), 0
	};
	build_families(&all, request, &dump, progress, rings);
	for (int i = 0; i < edges; ++i) {
		progress(all.rings, rings);
		build_integrand(&all, i < request->monomials ? &request->monomial[i]
			: &request->polynomial[i - request->monomials], request->scheme, &dump);
	}
	progress(rings, rings);
	return all;
}

/* trust.c - what a compensated area and a rigorous bound cost, in L1.
 *
 * The public functions on one ring of ITEMS vertices, beside the plain ones. */
#include "bench.h"

typedef enum { PLAIN_AREA, COMPENSATED, PLAIN, BOUNDED } What;

typedef struct { What what; int degree; } TrustJob;

static const int degrees[] = { 0, 1, 2, 3, 4, 6, 8 };
enum { DEGREES = (int)(sizeof degrees / sizeof *degrees), JOBS = 2 * DEGREES + 2 };

static double x[ITEMS], y[ITEMS];
static float xf[ITEMS], yf[ITEMS];

static void run_double(const void *context, long repeat)
{
	static double out[EW_MOMENTS(8)], bound[EW_MOMENTS(8)];
	const TrustJob *job = context;
	while (repeat-- > 0)
		switch (job->what) {
		case PLAIN_AREA: out[0] = ew_area(x, y, ITEMS); break;
		case COMPENSATED: out[0] = ew_area_compensated(x, y, ITEMS); break;
		case PLAIN: ew_moments(job->degree, x, y, ITEMS, out); break;
		case BOUNDED: ew_moments_bounded(job->degree, x, y, ITEMS, out, bound); break;
		}
}

static void run_float(const void *context, long repeat)
{
	static float out[EW_MOMENTS(8)], bound[EW_MOMENTS(8)];
	const TrustJob *job = context;
	while (repeat-- > 0)
		switch (job->what) {
		case PLAIN_AREA: out[0] = ew_areaf(xf, yf, ITEMS); break;
		case COMPENSATED: out[0] = ew_area_compensatedf(xf, yf, ITEMS); break;
		case PLAIN: ew_momentsf(job->degree, xf, yf, ITEMS, out); break;
		case BOUNDED: ew_moments_boundedf(job->degree, xf, yf, ITEMS, out, bound); break;
		}
}

static void trust_of_precision(Table *table, int precision, int rounds)
{
	TrustJob job[JOBS] = { { PLAIN_AREA, 0 }, { COMPENSATED, 0 } };
	Race race = race_new(rounds);
	for (int i = 0; i < DEGREES; ++i) {
		job[2 * i + 2] = (TrustJob){ PLAIN, degrees[i] };
		job[2 * i + 3] = (TrustJob){ BOUNDED, degrees[i] };
	}
	for (int i = 0; i < JOBS; ++i)
		race_add(&race, precision == DOUBLE ? run_double : run_float, &job[i], ITEMS);
	race_run(&race);
	for (int i = 0; i < JOBS; i += 2) {
		if (i == 0)
			table_row(table, "ew_area_compensated, %s", precision_names[precision]);
		else
			table_row(table, "ew_moments_bounded, degree %d, %s", job[i].degree,
				precision_names[precision]);
		table_put(table, race_median(&race, i));
		table_put(table, race_median(&race, i + 1));
		table_put(table, race_minimum(&race, i + 1));
		table_put(table, race_ratio(&race, i + 1, i));
		table_put(table, i == 0 && precision == DOUBLE ? 5.5 : (double)NAN);
	}
	race_free(&race);
}

void section_trust(const Effort *effort)
{
	Table *table = table_new("trust", "compensated area and rigorous bounds, L1, ns per edge",
		"Public functions on one ring, beside ew_area and ew_moments.");
	points_make(DOUBLE, x, ITEMS);
	points_make(DOUBLE, y, ITEMS);
	points_make(FLOAT, xf, ITEMS);
	points_make(FLOAT, yf, ITEMS);
	table_figures(table, "plain", "median", 3);
	table_figures(table, "trusted", "median", 3);
	table_figures(table, "trusted", "min", 3);
	table_figures(table, "", "ratio", 2);
	table_at_most(table);
	for (int precision = 0; precision < PRECISIONS; ++precision)
		trust_of_precision(table, precision, effort->rounds);
	table_print(table);
}

#include <stdio.h>
#include "low.h"
#include "high.h"

int main(void)
{
	const double x[] = { 0, 4, 4, 0 }, y[] = { 0, 0, 3, 3 };
	double m[HIGH_MOMENTS(HIGH_MAX_DEGREE)];
	high_moments(HIGH_MAX_DEGREE, x, y, 4, m);
	printf("area %g to degree %d, %g to degree %d\n", low_area(x, y, 4), LOW_MAX_DEGREE,
		m[HIGH_INDEX(0, 0)], HIGH_MAX_DEGREE);
	return 0;
}

#include <stdio.h>
#define EW_IMPLEMENTATION
#include "edgewise.h"

int main(void)
{
	const double xy[] = { 0, 0,  4, 0,  4, 3,  0, 3 };
	double m[EW_MOMENTS(0)];
	ew_moments_xy(0, xy, 4, m);
	printf("area %g\n", m[EW_INDEX(0, 0)]);
	return 0;
}

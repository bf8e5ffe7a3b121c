#include <stdio.h>
#include "edgewise.h"

int main(void)
{
	const double x[] = { 0, 4, 4, 0 }, y[] = { 0, 0, 3, 3 };
	printf("area %g\n", ew_area(x, y, 4));
	return 0;
}

#include <stdio.h>
#include "edgewise.h"

int main(void)
{
	const double x[] = { 0, 4, 4, 0 }, y[] = { 0, 0, 3, 3 };
	printf("area %g, under the hat %g\n", ew_area(x, y, 4), ew_hat(x, y, 4, 0, 0));
	return 0;
}

/* Contribution of the line edge (x0,y0) -> (x1,y1) to the integral of x^4 y^2:
 *
 *     1/840 (x0 y1 - x1 y0) times the sum of row times column times
 *
 *                   y0^2  y0 y1   y1^2
 *     x0^4      |     15      5      1 |
 *     x0^3 x1   |     10      8      3 |
 *     x0^2 x1^2 |      6      9      6 |
 *     x0 x1^3   |      3      8     10 |
 *     x1^4      |      1      5     15 |
 *
 * Sum it over a closed boundary; counterclockwise is positive. Unit: coordinate^8.
 * Error: at most gamma_16 times the same sum with every term positive; gamma_k = k u/(1 - k u),
 * u = 2^-53.
 * Swapping the ends negates the result bit for bit; a repeated vertex gives 0.
 * Cost: 31 mul, 15 add; depth 10. */
double ew_line_x4y2(double x0, double y0, double x1, double y1)
{
	const double y00 = y0 * y0;
	const double y01 = y0 * y1;
	const double t0 = 5.0 * y01;
	const double y11 = y1 * y1;
	const double row0 = (15.0 * y00 + t0) + y11;
	const double x00 = x0 * x0;
	const double x0000 = x00 * x00;
	const double row4 = y00 + (t0 + 15.0 * y11);
	const double x11 = x1 * x1;
	const double x1111 = x11 * x11;
	const double t1 = 8.0 * y01;
	const double row1 = (10.0 * y00 + t1) + 3.0 * y11;
	const double x01 = x0 * x1;
	const double x0001 = x00 * x01;
	const double row3 = (t1 + 10.0 * y11) + 3.0 * y00;
	const double x0111 = x11 * x01;
	const double row2 = (6.0 * y00 + 6.0 * y11) + 9.0 * y01;
	const double x0011 = x01 * x01;
	const double sum = ((row0 * x0000 + row4 * x1111) + (row1 * x0001 + row3 * x0111))
		+ row2 * x0011;
	const double s = x0 * y1 - x1 * y0;
	return 0x1.3813813813814p-10 /* 1/840 */ * (sum * s);
}

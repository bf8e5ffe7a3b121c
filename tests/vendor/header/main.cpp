#include <iostream>
#include <vector>
#include "edgewise.h"

int main()
{
	const std::vector<double> x { 0, 4, 4, 0 }, y { 0, 0, 3, 3 };
	std::cout << "area " << ew_area(x.data(), y.data(), x.size()) << '\n';
}

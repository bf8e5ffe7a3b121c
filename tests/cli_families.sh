# cli_families.sh - families and kinds of edges on gen's command line; cli.sh reads this file and has
# the helpers.

builtin='box tent bspline2 bspline3 catmull_rom mitchell'

# FAMILIES EDGES PRECISIONS FILTERS: the rows of prototypes.txt that belong to a request, as C.
prototypes() {
	awk -v families=",always,$1," -v edges=",any,$2," -v precisions="$3" -v filters="$4" '
		BEGIN {
			if (edges ~ /quad,conic,cubic/) edges = edges "all,"
			count = split(filters, filter, " ")
		}
		function show(text, end) {
			if (text !~ /REAL/) { print text; return }
			if (precisions ~ /float/) {
				match(text, /ew_[a-z0-9_]*[(]/)
				end = RSTART + RLENGTH - 1
				twin = substr(text, 1, end - 1) "f" substr(text, end)
				gsub(/REAL/, "float", twin)
				print twin
			}
			gsub(/REAL/, "double", text)
			if (precisions ~ /double/) print text
		}
		/^#/ || !index(families, "," $1 ",") || !index(edges, "," $2 ",") { next }
		{ sub(/^[^ ]* [^ ]* /, "") }
		!/NAME/ { show($0); next }
		{
			for (i = 1; i <= count; i++) {
				text = $0
				gsub(/NAME/, filter[i], text)
				show(text)
			}
		}' "$tests/prototypes.txt"
}

# names of the functions of the library, and of its filters, in C that comes in
functions() {
	grep -oE '[^a-z0-9_]ew_([a-z0-9_]+\(|filter_[a-z0-9_]+;)' | tr -dc 'a-z0-9_\n' | sort
}

# HEADER: what it declares
declared() {
	printf '#include "%s"\n' "$1" >includes.c
	$CC -E -P includes.c | functions
}

# FAMILIES EDGES PRECISIONS DEGREE OPTION...: header and objects have the functions of this request
# and no other, with the parameters that prototypes.txt says. $filters are those of the request.
interface() {
	families=$1 edges=$2 precisions=$3 degree=$4
	shift 4
	rm -rf d
	[ "$degree" -le 0 ] || families="$families,moments>0"
	gen "$@" --precision "$precisions" --targets portable --quiet --out d
	prototypes "$families" "$edges" "$precisions" "$filters" >prototypes
	functions <prototypes >wanted
	declared d/edgewise.h | grep -vE '^ew_line_x[0-9]' | diff wanted -
	[ "$(declared d/edgewise.h | grep -E '^ew_line_x[0-9]' | tr -d f | sort -u | wc -l)" -eq \
		$((degree < 0 ? 0 : (degree + 1) * (degree + 2) / 2)) ]
	{
		echo '#include "edgewise.h"'
		cat prototypes
	} >again.c
	$CC $STRICT -std=c99 -I d -fsyntax-only again.c
	build d $STRICT -std=c99 -O0
	symbols alone | sort -u >have
	sort -u wanted | comm -23 - have | refute grep .
}

families_have_their_functions() {
	both=double,float
	all=moments,curves,distance,closure,coverage,filters
	filters=$builtin
	interface $all line,quad,conic,cubic $both 1 --max-degree 1
	interface moments line double 2 --families moments --max-degree 2
	interface moments,curves line,quad,conic,cubic double 0 --families curves --max-degree 0
	interface moments line double 0 --families curves --edges line --max-degree 0
	interface distance line $both -1 --families distance
	interface closure line $both -1 --families closure
	interface distance,closure line float -1 --families closure,distance
	interface coverage line $both -1 --families coverage
	interface filters line $both -1 --families filters
	interface coverage,filters line double -1 --families filters,coverage
	filters='tent mitchell'
	interface filters line float -1 --filter tent --filter mitchell
	interface coverage,filters line double -1 --families coverage --filter tent \
		--filter mitchell
}
check families_have_their_functions

edges_have_their_functions() {
	all=moments,curves,distance,closure,coverage,filters
	filters=$builtin
	interface $all line,quad double 2 --edges quad --max-degree 2
	interface $all line,quad,cubic float 2 --edges cubic,quad --max-degree 2
	interface moments,curves line,conic double 1 --families curves --edges conic --max-degree 1
	interface moments,distance,closure,coverage,filters line double 0 --edges line \
		--max-degree 0
}
check edges_have_their_functions

# FAMILY: a program that calls one function of it
family_program() {
	case $1 in
	moments)  call='ew_line_area(1, 0, 0, 1) == 0.5' ;;
	curves)   call='ew_quad_area(1, 0, 1, 1, 0, 1) == 5 / 6.0' ;;
	distance) call='ew_line_distance(3, 4, 6, 8) == 0' ;;
	closure)  call='ew_line_closure(1, 2, 3, 4, 0, 0) == -10' ;;
	coverage) call='ew_below(0, 0, 1, 1, 0, 1, 0, 1) == 0.5' ;;
	filters)  call='ew_line_box(0.5, 0.25, -0.5, 0.25, 0, 0) == 0.75' ;;
	esac
	printf '#include "ew.h"\nint main(void) { return !(%s); }\n' "$call"
}

# COMPILER...: one file with all there is of a family, strictly, and a program
family_with() {
	printf '#define EW_IMPLEMENTATION\n#include "ew.h"\n' >implementation.c
	"$@" $STRICT -O0 -o main main.c implementation.c -lm
	./main
}

# FAMILY OPTION...: as C99 and C++17, by all compilers there are
family_alone() {
	gen --families "$@" --single-header ew.h
	family_program "$1" >main.c
	for compiler in gcc clang; do
		! has $compiler || family_with $compiler -std=c99
	done
	for compiler in g++ clang++; do
		! has $compiler || family_with $compiler -x c++ -std=c++17
	done
}
moments_alone() { family_alone moments --max-degree 1; }
curves_alone() { family_alone curves --max-degree 1; }
distance_alone() { family_alone distance; }
closure_alone() { family_alone closure; }
coverage_alone() { family_alone coverage; }
filters_alone() { family_alone filters --filter box --filter tent; }
for family in moments curves distance closure coverage filters; do
	check ${family}_alone
done

# One file, and kinds of edges mixed: the unit square with a quadratic right side that bulges by 2/3
# of 1/2, and a cubic left side whose control points are on it.
edges_in_a_single_header() {
	gen --edges quad,cubic --max-degree 2 --single-header ew.h
	cat >main.c <<-END
		#include "ew.h"
		int main(void)
		{
			const double sides = ew_line_area(0, 0, 1, 0) + ew_quad_area(1, 0, 1.5, 0.5, 1, 1)
				+ ew_line_area(1, 1, 0, 1) + ew_cubic_area(0, 1, 0, 0.75, 0, 0.25, 0, 0);
			const double error = sides - 7.0 / 6;
			return error < -1e-15 || error > 1e-15;
		}
	END
	# shellcheck disable=SC2086
	family_with $CC -std=c99
}
check edges_in_a_single_header

# A filter of the user's, under a prefix: its functions and its name are emitted as those of the
# built-in ones are. Over the whole plane a hat of height 1 and width 2 has 1 on each axis.
custom_filter() {
	printf 'filter hat\nseparable even\npiece 0 1 : 1 - x\n' >my.filter
	gen --filter my.filter --filter tent --prefix foo --targets portable,fma --out d
	cat >main.c <<-END
		#include "foo.h"
		int main(void)
		{
			static const double x[] = { -3, 2, 2, -3 }, y[] = { -3, -3, 0, 0 };
			static const float xf[] = { -3, 2, 2, -3 }, yf[] = { -3, -3, 0, 0 };
			const foo_filter *filters[] = { &foo_filter_hat, &foo_filter_tent };
			return !(foo_hat(x, y, 4, 0, 0) == 0.5 && foo_hatf(xf, yf, 4, 0, 0) == 0.5f
				&& foo_line_hat(1, 0.5, -2, 0.25, 0, 0)
				== foo_line_tent(1, 0.5, -2, 0.25, 0, 0)
				&& filters[0] != filters[1]);
		}
	END
	run_with d
	grep -rnE '(^|[^A-Za-z0-9_])(ew|EW)(_|[^A-Za-z0-9]|$)' d | refute grep .
	symbols alone | grep -qx foo_deposit_hat_portable
}
check custom_filter

# DEGREES CURVES OPTION...: what the header promises
promises() {
	degrees=$1 curves=$2
	shift 2
	rm -rf d
	gen "$@" --quiet --out d
	sed -n 's/^#define EW_MAX_\(CURVE_\)*DEGREE //p' d/edgewise.h | tr '\n' ' ' >got
	[ "$(cat got)" = "$degrees $curves${curves:+ }" ]
}

degrees_of_curves() {
	promises 0 0 --max-degree 0
	promises 1 1 --max-degree 1 --families curves
	promises 9 8 --max-degree 9 --precision float
	promises 12 12 --max-degree 12 --edges quad --precision double
	promises 5 '' --max-degree 5 --families moments
	promises 5 '' --max-degree 5 --edges line
	promises 4 4 --families curves
	refute grep -q DEGREE d/edgewise_kernels.h
	gen --families distance --out distance
	refute grep -q EW_MAX_ distance/edgewise.h
}
check degrees_of_curves

# Degree 12 of a quadratic whose control points are on a line from (0,0) to (1,1) and, for the rest
# of the triangle, two line edges: x^12 over the triangle (0,0), (1,1), (0,1) is 1/(13 14).
degree_12() {
	gen --max-degree 12 --edges quad --precision double --targets portable --out d
	cat >main.c <<-END
		#include "edgewise.h"
		#include <math.h>
		int main(void)
		{
			static double a[EW_MOMENTS(12)], b[EW_MOMENTS(12)], c[EW_MOMENTS(12)];
			const int last = EW_INDEX(12, 0);
			if (ew_quad_moments(12, 0, 0, 0.5, 0.5, 1, 1, a) != EW_OK
			    || ew_line_moments(12, 1, 1, 0, 1, b) != EW_OK
			    || ew_line_moments(12, 0, 1, 0, 0, c) != EW_OK
			    || ew_quad_moments(13, 0, 0, 0.5, 0.5, 1, 1, a) != EW_BAD_DEGREE)
				return 1;
			return fabs(a[last] + b[last] + c[last] - 1.0 / 182) > 1e-15;
		}
	END
	run_with d
}
check degree_12

# The command in a banner makes the same files again.
command_of_a_banner() {
	for request in '--families curves --edges cubic' '--edges quad,line --max-degree 3' \
		'--families closure,distance --precision float' '--monomial x4y2 --edges cubic' \
		'--monomial x4y2 --edges line,quad --targets avx2'; do
		rm -rf d e
		# shellcheck disable=SC2086
		gen $request --quiet --out d
		command=$(sed -n 's/^ \*     gen //p' d/edgewise.h)
		# shellcheck disable=SC2086
		gen $command --quiet --out e
		diff -r d e
		for word in $request; do
			case $word in --*) echo "$command" | grep -q -e "$word" ;; esac
		done
	done
}
check command_of_a_banner

monomial_of_an_edge() {
	gen --monomial x4y2 --edges cubic --out d
	[ "$(declared d/edgewise.h | tr '\n' ' ')" = 'ew_cubic_x4y2 ew_cubic_x4y2f ' ]
	find d -name '*ring*' -o -name '*_fma.c' -o -name '*_moments*' | refute grep .
	build d $STRICT -std=c99
	[ "$(symbols alone | tr '\n' ' ')" = 'ew_cubic_x4y2 ew_cubic_x4y2f ' ]
	gen --monomial x4y2 --edges cubic --single-header ew.h
	[ "$(declared ew.h | tr '\n' ' ')" = 'ew_cubic_x4y2 ew_cubic_x4y2f ' ]
	printf '#define EW_IMPLEMENTATION\n#include "ew.h"\n' >implementation.c
	$CC $STRICT -std=c99 -c implementation.c
	nm -P -g implementation.o | grep -c ' T ' | grep -qx 2
}
check monomial_of_an_edge

prefix_of_curves() {
	gen --prefix foo --edges quad,conic --max-degree 1 --targets portable --out d
	cat >main.c <<-END
		#include "foo.h"
		int main(void)
		{
			double out[FOO_MOMENTS(FOO_MAX_CURVE_DEGREE)];
			return foo_conic_moments(1, 1, 0, 1, 1, 0, 1, 1, out) != FOO_OK
				|| foo_quad_area(1, 0, 1, 1, 0, 1) != 5 / 6.0
				|| foo_line_distance(3, 4, 6, 8) != 0;
		}
	END
	run_with d
	gen --prefix foo --monomial x2y1 --edges quad --out m
	grep -rniE '(^|[^a-z0-9_])ew_|edgewise' m | refute grep .
}
check prefix_of_curves

#!/bin/sh
# symbols.sh [BUILD] - what the objects of emissions bring into someone else's program.
#
# Every name begins with the prefix, also of what is static, since a single header puts it among the
# user's own. No global constructor, nothing thread-local, nothing writable but the two words in
# which dispatch remembers the CPU, no allocation but by images, and of the C library only what is
# listed here. BUILD/lib is the library as it is built; other emissions are as small as can be with
# every kind of file that there is, in C and in C++.
set -u
build=$(cd "${1:-build}" && pwd) || exit 1
. "$(dirname "$0")/verdict.sh"
CC=${CC:-cc}
CXX=${CXX:-c++}

# PREFIX OBJECT...: one line for each thing that is not as it should be
faults() {
	prefix=$1
	shift
	objdump -C -t -h "$@" | awk -v prefix="${prefix}_" '
		function fault(text) { print object ": " text }
		function ours(name) { return index(name, prefix) == 1 }
		BEGIN {
			count = split("fabs fabsf sqrt sqrtf fma fmaf floor ceil frexp ldexp ldexpf " \
				"nextafter nextafterf memcpy memset memmove memcmp strcmp " \
				"_GLOBAL_OFFSET_TABLE_ __stack_chk_fail", list, " ")
			for (i = 1; i <= count; i++) library[list[i]] = 1
			# Of images alone; compilers make calloc of malloc and memset.
			library["malloc"] = library["calloc"] = library["free"] = 2
		}
		/file format/ { object = $1; sub(/.*\//, "", object); sub(/:$/, "", object); next }
		/^ *[0-9]+ \.(init_array|ctors|preinit_array)/ { fault("global constructors") }
		/^ *[0-9]+ \.t(bss|data)/ { fault("thread-local data") }
		!/^[0-9a-f]+ .......? / { next }
		{
			flags = substr($0, 18, 7)
			rest = substr($0, 26)
			section = substr(rest, 1, index(rest, "\t") - 1)
			name = substr(rest, index(rest, "\t") + 1)
			sub(/^[0-9a-f]+ +(\.hidden )?/, "", name)
		}
		flags ~ /[df]/ && flags !~ /[FO]/ { next }              # of sections and files
		name ~ /^(DW\.ref\.)?__gxx_personality_v0$/ { next }    # of g++ -O0 where it inlines
		section == "*UND*" {
			if (ours(name)) next
			if (!library[name]) fault("needs " name)
			else if (library[name] == 2 && object !~ /_raster/) fault("allocates by " name)
			next
		}
		# What is static in a function, and tables of compilers, have a number.
		!ours(name) && name !~ /^\.L|^[A-Za-z0-9_]+\.[0-9]+$/ { fault("defines " name) }
		section ~ /^(\.data|\.bss|\*COM\*)/ && section !~ /^\.data\.rel\.ro/ &&
		name != prefix "cpu_available" && name != prefix "cpu_forced" {
			fault("can write to " name)
		}'
}

# FOLDER COMPILER...: objects of all files in it, from inside
compile() {
	(cd "$1" && shift && "$@" -O0 -c ./*.c) >"$work/log" 2>&1 ||
		grep -E -m 1 'error' "$work/log" || tail -n 1 "$work/log"
}

# LANGUAGES NAME PREFIX OPTION...: an emission in C and, if asked for, in C++
emission() {
	languages=$1 name=$2 prefix=$3
	shift 3
	folder=$work/$(echo "$name" | tr ' ' _)
	"$build/gen" --quiet --prefix "$prefix" --out "$folder" "$@" >/dev/null || exit 1
	for language in $languages; do
		case $language in
		C)   compiler=$CC ;;
		C++) compiler="$CXX -x c++ -std=c++17" ;;
		esac
		has "${compiler%% *}" || { skip "$name, $language" "no compiler"; continue; }
		verdict "$name, $language" "$(compile "$folder" $compiler
			faults "$prefix" "$folder"/*.o | head -n 1)"
	done
	rm -r "$folder"
}

# A control: each of these is found, and nothing besides.
test_control() {
	cat >"$work/bad.c" <<-END
		#include <stdlib.h>
		#include <stdio.h>
		int counter;
		static const int table[] = { 1, 2 };
		static int ew_kept = 1;
		static __thread int ew_own;
		__attribute__((constructor)) static void ew_start(void) { ew_kept = ew_own++; }
		void *ew_new(size_t n) { static int calls; return malloc(n + calls++ + table[n]); }
		void ew_say(void) { puts("done"); }
	END
	$CC -O0 -c -o "$work/bad.o" "$work/bad.c" || exit 1
	faults ew "$work/bad.o" | sed 's/\.[0-9]*$//' | sort >"$work/found"
	sort >"$work/wanted" <<-END
		bad.o: allocates by malloc
		bad.o: can write to calls
		bad.o: can write to counter
		bad.o: can write to ew_kept
		bad.o: defines counter
		bad.o: defines table
		bad.o: global constructors
		bad.o: needs puts
		bad.o: thread-local data
	END
	verdict "each fault is found" "$(diff "$work/wanted" "$work/found" | sed -n 2p)"
}

test_control
verdict "the library" "$(faults ew "$build"/lib/*.o | head -n 1)"
emission C++ 'all families' ew --max-degree 0
for family in moments curves distance closure coverage filters; do
	case $family in
	moments | curves) set -- --max-degree 0 ;;
	*)                set -- ;;
	esac
	emission C $family ew --families $family --precision double "$@"
done
emission 'C C++' 'a monomial' ew --monomial x4y2 --edges line,quad,cubic
emission 'C C++' 'a polynomial' ew --polynomial 'soft=(1-x)*(1-y)'
emission 'C C++' 'a filter' ew --filter "$tests/filters/roof.filter"
emission 'C C++' 'another prefix' my_area --max-degree 0 --edges line --polynomial p=x
finish

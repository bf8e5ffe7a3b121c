#!/bin/sh
# msvc.sh [BUILD] - an emitted folder as compilers in the manner of MSVC take it: clang for
# Windows, to objects, without a Windows SDK.
#
# `clang-cl` is clang as it is there: no __GNUC__, and an <immintrin.h> that leaves out what no
# flag names. `msvc` comes as near to MSVC as clang can: __clang__ is not defined, so attributes
# are empty and dispatch asks the CPU by __cpuidex; what MSVC always has must be allowed by flags
# then, and nothing of our own lines may be in GNU's spelling once the preprocessor is through.
# The little of the C library that the folder needs is declared below, as the SDK declares it.
# Dispatch also runs that way, on simulated CPUs (tests/dispatch.c). What MSVC itself makes of
# all this is not shown here. Degree 2 has every scheme that higher degrees have.
set -u
build=${1:-build}
. "$(dirname "$0")/verdict.sh"
emitted=$work/emitted
"$build/gen" --quiet --max-degree 2 --out "$emitted" || exit 1

CLANG="clang -ffreestanding -isystem $work/include -I$emitted -O0 -Wall -Wextra -Wpedantic"
CLANG="$CLANG -Wconversion -Wshadow -Wundef -Wdouble-promotion -Wcast-qual -Werror"
X64=--target=x86_64-pc-windows-msvc
MSVC="-U__clang__ -Wno-unknown-pragmas -Wno-language-extension-token -mxsave"
MSVC="$MSVC -mavx2 -mfma -mavx512f -mavx512vl -mavx512dq"

sdk() {
	mkdir "$work/include" || exit 1
	cat >"$work/include/math.h" <<-'END'
		#ifdef __cplusplus
		extern "C" {
		#endif
		double fabs(double), sqrt(double), fma(double, double, double);
		double floor(double), ceil(double);
		float fabsf(float), sqrtf(float), fmaf(float, float, float);
		double frexp(double, int *), ldexp(double, int);
		float ldexpf(float, int), nextafterf(float, float);
		double nextafter(double, double);
		#ifdef __cplusplus
		}
		#endif
		#define INFINITY ((float)(1e300 * 1e300))
		#define NAN ((float)(INFINITY * 0.0F))
	END
	cat >"$work/include/stdlib.h" <<-'END'
		#include <stddef.h>
		#ifdef __cplusplus
		extern "C" {
		#endif
		void *malloc(size_t);
		void free(void *);
		#ifdef __cplusplus
		}
		#endif
	END
	cat >"$work/include/string.h" <<-'END'
		#include <stddef.h>
		#ifdef __cplusplus
		extern "C" {
		#endif
		void *memcpy(void *, const void *, size_t), *memset(void *, int, size_t);
		int strcmp(const char *, const char *);
		#ifdef __cplusplus
		}
		#endif
	END
}

# compiles NAME FILES FLAGS...: without a word; for the sake of time to an object only where
# attributes and flags must fit the intrinsics, which the front end does not judge
compiles() {
	name=$1 files=$2
	shift 2
	verdict "$name" "$(for file in "$emitted"/$files.c; do
		$CLANG -c -o "$work/object" "$@" "$file" 2>&1
	done | grep -E -m 1 'error|warning')"
}

# builds NAME TARGETS FLAGS...: these targets, and no other
builds() {
	name=$1 want=$2
	shift 2
	got=$(for target in FMA AVX2 AVX512 NEON; do
		printf '#include "edgewise_kernels.h"\n#if !EW_BUILD_%s\n#error no\n#endif\n' \
			$target >"$work/target.c"
		$CLANG "$@" -fsyntax-only "$work/target.c" >"$work/log" 2>&1 && echo $target
	done | tr '\n' ' ')
	verdict "$name" "$([ "$got" = "$want " ] || echo "$got, not $want")"
}

# own FLAGS...: our own lines as the compiler sees them, without the names behind intrinsics
own() {
	for file in "$emitted"/*.c; do
		$CLANG "$@" -E "$file" 2>&1
	done | awk -v folder="$emitted/" '
		/^# [0-9]+ "/ { own = index($0, folder); next }
		own           { gsub(/__builtin_ia32_/, ""); print }'
}

# Its tests count as tests of this suite.
simulated() {
	: >"$work/intrin.h"
	if ! ${CC:-cc} -std=gnu11 -U__clang__ -I"$work" -I"$tests" -I"$emitted" \
			-o "$work/dispatch" "$tests/dispatch.c" >"$work/log" 2>&1; then
		verdict 'simulated CPUs' "$(grep -m 1 error "$work/log")"
		return
	fi
	"$work/dispatch" >"$work/out" 2>&1 || failed=$((failed + 1))
	grep -E '^(ok|not ok) ' "$work/out"
	passed=$((passed + $(grep -c '^ok ' "$work/out")))
}

simulated
if ! command -v clang >/dev/null; then
	skip "msvc" "clang is not installed"
	echo "$passed passed, $failed failed"
	[ $failed -eq 0 ]
	exit
fi
sdk
compiles 'clang-cl C' '*' $X64 -std=c11
compiles 'clang-cl C++' '*' $X64 -x c++ -std=c++17 -fsyntax-only
compiles 'clang-cl arm64' '*' --target=aarch64-pc-windows-msvc -std=c11 -fsyntax-only
compiles 'clang-cl i686' '*' --target=i686-pc-windows-msvc -msse2 -std=c11 -fsyntax-only
compiles 'msvc C' '*' $X64 -std=c11 $MSVC
compiles 'msvc C++, runtime' 'edgewise_[cdr]*' $X64 -x c++ -std=c++17 -fsyntax-only $MSVC
builds 'clang-cl targets' 'FMA AVX2 AVX512' $X64 -std=c11
builds 'msvc targets' 'FMA AVX2 AVX512' $X64 -std=c11 $MSVC
builds 'clang-cl arm64 targets' 'FMA NEON' --target=aarch64-pc-windows-msvc -std=c11
own $X64 -std=c11 $MSVC >"$work/own"
verdict 'msvc dispatch asks by __cpuidex and _xgetbv' "$(
	for call in __cpuidex _xgetbv; do
		grep -q "$call(" "$work/own" || printf 'no %s ' $call
	done)"
verdict 'msvc sees nothing in the spelling of GNU' \
	"$(grep -E -m 1 '__attribute__|__asm|__atomic|__builtin|__extension__' "$work/own")"
finish

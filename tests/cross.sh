#!/bin/sh
# cross.sh - the emitted library on other machines: the same bits everywhere.
#
#     sh tests/cross.sh [BUILD]              compares with tests/hashes.txt
#     sh tests/cross.sh [BUILD] accept       takes this machine's results as right
#
# tests/hash.c and BUILD/emitted are compiled for each machine by its cross compiler, linked
# statically and run under qemu-user, which does floating point by itself in software, or, for
# WebAssembly, in node. What each machine finds among the targets is asserted, and its hashes must be
# the committed ones: one for `portable` and wasm128, which have no fused operations, one, `fused`,
# for every target that has them, one for the edges and one for images of the box, whatever the
# target.
# On s390x gcc evaluates float expressions in double in its ISO modes (FLT_EVAL_METHOD 1), which
# keeps the bounds but not the bits of float results; -fexcess-precision=fast keeps both. x87
# registers (FLT_EVAL_METHOD 2) break the bounds: every emitted file must refuse them, and nothing
# else. A machine whose compiler or emulator is missing is skipped by name.
set -u
build=${1:-build}
. "$(dirname "$0")/verdict.sh"
emitted=$(cd "$build/emitted" && pwd) || exit 1
hashes=$tests/hashes.txt

STRICT="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wundef -Wdouble-promotion -Wcast-qual"
STRICT="$STRICT -Werror"

# links COMPILER FLAGS...: it makes programs, so it has a C library
links() {
	printf '#include <math.h>\n#include <stdio.h>\n%s\n' \
		'int main(int n, char **p) { (void)p; return printf("%g", fma(n, n, n)) < 0; }' \
		>"$work/probe.c"
	"$@" -static -o "$work/probe" "$work/probe.c" -lm >/dev/null 2>&1
}

# program COMPILER FLAGS...: sets $folder, which then holds the program `hash.exe` (compilers for
# Windows insist on that name), or `log` alone
program() {
	folder=$work/$(echo "$*" | tr -d ' /')
	[ -d "$folder" ] && return
	mkdir "$folder" || exit 1
	( cd "$folder" && "$@" $STRICT -I"$emitted" -c "$emitted"/*.c "$tests/hash.c" &&
		"$@" -static -o hash.exe ./*.o -lm ) >"$folder/log" 2>&1 || rm -f "$folder/hash.exe"
	rm -f "$folder"/*.o
}

# results NAME EMULATOR COMPILER FLAGS...: what `hash` prints, in $work/NAME
results() {
	name=$1 emulator=$2
	shift 2
	for tool in ${emulator%% *} "$1"; do
		has "$tool" || { skip "$name" "$tool is not installed"; return 1; }
	done
	links "$@" || { skip "$name" "$1 has no static C library for it"; return 1; }
	program "$@"
	if [ ! -x "$folder/hash.exe" ]; then
		verdict "$name compiles" "$(grep -E -m 1 'error|warning|undefined|cannot find' \
			"$folder/log" || tail -n 1 "$folder/log")"
		return 1
	elif ! $emulator "$folder/hash.exe" >"$work/$name" 2>"$work/log"; then
		verdict "$name runs" "$(tail -n 1 "$work/log")"
		return 1
	fi
}

class_of() {
	case $1 in
	portable | edges | box) echo "$1" ;;
	wasm128) echo portable ;;
	*) echo fused ;;
	esac
}

# compare RESULTS HASHES: one line for each difference
compare() {
	while read -r target hash; do
		want=$(awk -v class="$(class_of "$target")" '$1 == class { print $2 }' "$2")
		[ "$hash" = "$want" ] || echo "$target $hash instead of ${want:-nothing}"
	done <"$1"
}

targets_in() {
	awk '$1 != "edges" && $1 != "box" { print $1 }' "$1" | tr '\n' ' ' | sed 's/ $//'
}

# machine NAME TARGETS EMULATOR COMPILER FLAGS...: `any` targets are not judged
machine() {
	name=$1 want=$2
	shift 2
	results "$name" "$@" || return
	got=$(targets_in "$work/$name")
	case $want in any | "$got") problem= ;; *) problem="not $want" ;; esac
	verdict "$name targets: $got" "$problem"
	verdict "$name bits: $got edges box" "$(compare "$work/$name" "$hashes" | head -n 1)"
}

# ---- x87 ----

X87='#error.*-msse2 -mfpmath=sse'

# says COMMAND...: refuses, compiles, or the first thing it says
says() {
	if "$@" -c -o "$work/object" >"$work/log" 2>&1; then
		echo compiles
	elif grep -q -e "$X87" "$work/log"; then
		echo refuses
	else
		head -n 1 "$work/log"
	fi
}

# x87 refuses|compiles COMPILER FLAGS...
x87() {
	want=$1
	shift
	has "$1" || { skip "x87 $*" "$1 is not installed"; return; }
	got=$(says "$@" "$emitted/edgewise_finish.c")
	verdict "x87 $want $*" "$([ "$got" = "$want" ] || echo "$got")"
}

every_file_refuses() {
	has i686-linux-gnu-gcc || { skip "x87 every file" "no i686-linux-gnu-gcc"; return; }
	"$build/gen" --quiet --max-degree 2 --single-header "$work/single.h" || exit 1
	printf '#define EW_IMPLEMENTATION\n#include "single.h"\n' >"$work/single.c"
	verdict "x87 every file refuses" "$(for file in "$emitted"/*.c "$work/single.c"; do
		got=$(says i686-linux-gnu-gcc -Wfatal-errors "$file")
		[ "$got" = refuses ] || echo "$(basename "$file"): $got"
	done | head -n 1)"
}

test_x87() {
	every_file_refuses
	x87 refuses i686-linux-gnu-gcc -std=c99 -msse2
	x87 refuses i686-linux-gnu-gcc -std=gnu11 -msse -mfpmath=sse
	x87 refuses clang --target=i586-linux-gnu -ffreestanding
	! has i686-linux-gnu-gcc || x87 refuses i386-tcc -I/usr/i686-linux-gnu/include
	for std in c99 gnu11; do
		x87 compiles i686-linux-gnu-gcc -std=$std -msse2 -mfpmath=sse
		x87 compiles gcc -std=$std
		x87 compiles clang -std=$std
		x87 compiles aarch64-linux-gnu-gcc -std=$std
		x87 compiles s390x-linux-gnu-gcc -std=$std
	done
	x87 compiles g++ -x c++ -std=c++17
	x87 compiles clang++ -x c++ -std=c++17
	x87 compiles gcc -ffast-math -DEW_ALLOW_FAST_MATH
	x87 compiles tcc
}

# ---- machines ----

CC=${CC:-cc}
case $(uname -m) in
x86_64) x86=$CC ;;
*) x86=x86_64-linux-gnu-gcc ;;
esac

test_machines() {
	machine native any '' $CC -std=c99 -O2
	machine nehalem 'portable' 'qemu-x86_64 -cpu Nehalem' $x86 -std=c99 -O2
	machine haswell 'portable fma avx2' 'qemu-x86_64 -cpu Haswell' $x86 -std=c99 -O2
	machine 'haswell without avx2' 'portable fma' 'qemu-x86_64 -cpu Haswell,-avx2' \
		$x86 -std=c99 -O2
	machine 'haswell without xsave' 'portable' 'qemu-x86_64 -cpu Haswell,-xsave' \
		$x86 -std=c99 -O2
	machine aarch64 'portable fma neon' qemu-aarch64 aarch64-linux-gnu-gcc -std=c99 -O2
	machine i686 'portable' qemu-i386 i686-linux-gnu-gcc -std=c99 -O2 -msse2 -mfpmath=sse
	machine s390x 'portable fma' qemu-s390x s390x-linux-gnu-gcc -std=c99 -O2 \
		-fexcess-precision=fast
	machine wasm32 'portable wasm128' "node --no-warnings $tests/wasi.mjs" \
		clang --target=wasm32-wasi -msimd128 -std=c99 -O2
	machine 'wasm32 without simd128' portable "node --no-warnings $tests/wasi.mjs" \
		clang --target=wasm32-wasi -std=c99 -O2
}

# windows PROGRAM: on this CPU, whose targets it finds, but with the calling convention, the stack
# and the C library of Windows. Lines end in CR there.
windows() {
	WINEPREFIX=$work/wine WINEDEBUG=-all wine "$1" >"$work/lines" && tr -d '\r' <"$work/lines"
}

test_windows() {
	has wine || { skip windows "wine is not installed"; return; }
	machine windows any windows x86_64-w64-mingw32-gcc -std=c99 -O2
	[ ! -d "$work/wine" ] || WINEPREFIX=$work/wine wineserver -k -w
}

# What mingw's C library gives without optimization would spoil the exact error of a product.
test_fma() {
	has x86_64-w64-mingw32-gcc || { skip "fma of mingw" "it is not installed"; return; }
	printf '#include "edgewise_kernels.h"\n#if EW_BUILD_FMA\n#error fma\n#endif\n' >"$work/fma.c"
	for level in 0 1; do
		x86_64-w64-mingw32-gcc -O$level -I"$emitted" -fsyntax-only "$work/fma.c" 2>/dev/null
		got=$?
		verdict "fma of mingw -O$level" "$([ $got -eq $level ] || echo "it is the other way")"
	done
}

# A control: with all committed hashes altered, each line of this machine must be reported.
test_control() {
	[ -s "$work/native" ] || return
	sed 's/\(.*\) /\1 0/' "$hashes" >"$work/altered"
	verdict "a wrong hash is reported" "$(
		[ "$(compare "$work/native" "$work/altered" | wc -l)" -eq \
			"$(wc -l <"$work/native")" ] || echo "it was not")"
}

# ---- accept ----

# hashes_of CLASS: the different ones on this machine
hashes_of() {
	while read -r target hash; do
		[ "$(class_of "$target")" != "$1" ] || echo "$hash"
	done <"$work/native" | sort -u
}

accept() {
	results native '' $CC -std=c99 -O2 || : >"$work/native"
	echo "# Written by make accept-hashes: what tests/hash.c prints on every machine." \
		>"$work/accepted"
	for class in portable fused edges box; do
		set -- $(hashes_of $class)
		case $# in
		0) verdict "accept $class" "no target of this machine has it" ;;
		1) verdict "accept $class $1"; echo "$class $1" >>"$work/accepted" ;;
		*) verdict "accept $class" "the targets of this machine disagree: $*" ;;
		esac
	done
	[ $failed -ne 0 ] || cp "$work/accepted" "$hashes"
}

if [ "${2:-}" = accept ]; then
	accept
else
	test_machines
	test_windows
	test_fma
	test_control
	test_x87
fi
finish

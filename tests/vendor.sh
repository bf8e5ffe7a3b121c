#!/bin/sh
# vendor.sh [BUILD] [WAY...] - every way from an empty folder to a program that prints an area.
#
# A folder of tests/vendor is what a user has in a repository of their own; each of its files
# WAY.commands is one way to build it. The first lines say which tools that needs and what must be
# printed; of the rest at most three build a program and the last one runs it. All are run as they
# stand there, in a copy of the folder. `make install` is the administrator's part and comes before
# those that need `installed`. Without names all ways are taken, and what holds of an installation,
# of rebuilding and of a single header is tested too. The way of MSVC ends before the linker, in
# msvc.sh.
set -u
build=$(cd "${1:-build}" && pwd) || exit 1
[ $# -eq 0 ] || shift
. "$(dirname "$0")/verdict.sh"
LC_ALL=C
export LC_ALL
projects="$work/my projects"        # a space is nothing special
prefix=$work/usr
mkdir "$work/bin" "$projects" || exit 1
cp "$build/gen" "$work/bin/edgewise-gen" || exit 1

PATH=$work/bin:$PATH
PKG_CONFIG_PATH=$prefix/lib/pkgconfig
CMAKE_PREFIX_PATH=$prefix
LD_LIBRARY_PATH=$prefix/lib
WINEPREFIX=$work/wine
WINEDEBUG=-all
export PATH PKG_CONFIG_PATH CMAKE_PREFIX_PATH LD_LIBRARY_PATH WINEPREFIX WINEDEBUG

clean_up() {
	[ ! -d "$WINEPREFIX" ] || wineserver -k -w 2>/dev/null
	rm -rf "$work"
}
trap clean_up EXIT

# ARGUMENT...: the Makefile of this project, by the library that is there
make_here() {
	make -s -C "$root" B="$build" "$@" >"$work/make.log" 2>&1 || tail -n 1 "$work/make.log"
}

# Once for all ways; says what is wrong.
installed() {
	[ -d "$prefix" ] || make_here install PREFIX="$prefix"
}

# ---- ways ----

# KEY FILE: the words of its line `# KEY words`
words() {
	sed -n "s/^# $1 //p" "$2"
}

# FILE: its commands in turn, the first that fails ends it
run_commands() {
	grep -v '^#' "$1" >"$work/commands"
	while read -r command; do
		echo "+ $command" >&2
		sh -c "$command" </dev/null || return 1
	done <"$work/commands"
}

# NAME FILE: what is wrong with this way, in a folder of its own
try() {
	[ "$(grep -cv '^#' "$2")" -le 4 ] || { echo "more than three commands"; return; }
	cp -R "$(dirname "$2")" "$projects/$1"
	cd "$projects/$1" || return
	rm ./*.commands
	if ! run_commands "$2" >"$work/out" 2>"$work/log"; then
		echo "$(grep '^+' "$work/log" | tail -n 1): $(
			cat "$work/log" "$work/out" | grep -E -m 1 'rror|undefined|cannot' ||
			cat "$work/log" "$work/out" | tail -n 1)"
	elif ! tail -n 1 "$work/out" | tr -d '\r' | grep -qxF "$(words prints "$2")"; then
		echo "printed $(tail -n 1 "$work/out")"
	fi
}

# NAME: as tests/vendor has it
way() {
	file=$tests/vendor/$1.commands
	name=$(echo "$1" | tr / ' ')
	for tool in $(words needs "$file"); do
		if [ "$tool" = installed ]; then
			problem=$(installed)
			[ -z "$problem" ] || { verdict "$name" "$problem"; return; }
		elif ! has "$tool"; then
			skip "$name" "$tool is not installed"
			return
		fi
	done
	verdict "$name" "$(try "$name" "$file")"
}

# ---- what must be rebuilt ----

# WORD...: what ninja would do next, with the reasons, mentions each; without words, it is nothing
next_steps() {
	ninja -C build -n -d explain >"$work/next" 2>&1
	if [ $# -eq 0 ]; then
		grep -q 'no work to do' "$work/next" || grep -m 1 explain "$work/next"
	fi
	for word; do
		grep -q -e "$word" "$work/next" || echo "$word is no reason to do anything"
	done
}

# In the folder of a way that has run: gen runs when a filter has changed and for no other reason,
# and what it writes is compiled when it is new.
rebuilding() {
	next_steps
	touch main.c
	next_steps main.c
	! grep -q edgewise.h "$work/next" || echo "main.c makes gen run"
	ninja -C build >/dev/null
	next_steps
	touch hat.filter
	next_steps hat.filter edgewise.h
	steps=$(ninja -C build | grep -c '^\[')
	[ "$steps" -eq 1 ] || echo "$steps steps, not gen's alone, after a change of nothing"
	next_steps
	sed -i 's/1 - x/2 - 2*x/' hat.filter
	ninja -C build >/dev/null
	build/main | grep -x 'area 12, under the hat 1' >/dev/null || build/main
	next_steps
}

test_rebuilding() {
	for tool in cmake meson; do
		[ -x "$projects/hat $tool/build/main" ] || continue
		cd "$projects/hat $tool" || exit 1
		verdict "hat $tool: rebuilt when the filter changes, and only then" \
			"$(rebuilding | head -n 1)"
	done
}

# ---- what is installed ----

in_stage() {
	make_here "$1" DESTDIR="$work/stage" PREFIX=/opt/edgewise LIBDIR=/opt/edgewise/lib64
}

# What a packager gets: nothing outside of the prefix, no path of the machine that built it, a
# package that finds itself wherever it is unpacked, and nothing left behind.
test_staging() {
	stage=$work/stage/opt/edgewise
	verdict 'installed into a stage' "$(in_stage install
		(cd "$stage" && find . ! -type d | sort) >"$work/files"
		diff - "$work/files" <<-END | sed -n 2p
			./bin/edgewise-gen
			./include/edgewise.h
			./lib64/cmake/edgewise/edgewise-config-version.cmake
			./lib64/cmake/edgewise/edgewise-config.cmake
			./lib64/libedgewise.a
			./lib64/libedgewise.so
			./lib64/libedgewise.so.$abi
			./lib64/libedgewise.so.$version
			./lib64/pkgconfig/edgewise.pc
			./share/bash-completion/completions/edgewise-gen
			./share/man/man1/edgewise-gen.1
			./share/man/man3/edgewise.3
		END
		find "$work/stage" -type f ! -path "$stage/*" | head -n 1
		grep -rlF -e "$work" -e "$build" "$stage" | head -n 1)"
	verdict 'pkg-config file of a stage' "$(
		got=$(PKG_CONFIG_SYSROOT_DIR=$work/stage PKG_CONFIG_PATH=$stage/lib64/pkgconfig \
			pkg-config --cflags --libs edgewise)
		[ "$got" = "-I$stage/include -L$stage/lib64 -ledgewise " ] || echo "$got")"
	if has cmake && has ninja; then
		cp -R "$tests/vendor/area" "$work/moved"
		mv "$stage" "$work/elsewhere"
		verdict 'CMake package of a tree that was moved' "$(
			cd "$work/moved" && export CMAKE_PREFIX_PATH="$work/elsewhere" &&
			run_commands area/find-package.commands 2>&1 | grep -E -m 1 'rror')"
		mkdir -p "${stage%/*}"
		mv "$work/elsewhere" "$stage"
	fi
	verdict 'uninstalled' "$(in_stage uninstall; find "$work/stage" ! -type d | head -n 1)"
}

# The functions and filters of the static library that the installed header speaks of, comments
# aside: what install.mk exports is found in another way.
declared() {
	cc -E -P "$prefix/include/edgewise.h" | grep -oE '[A-Za-z0-9_]+' | sort -u >"$work/words"
	nm -P -g --defined-only "$prefix/lib/libedgewise.a" | awk 'NF > 2 { print $1 }' | sort -u |
		comm -12 - "$work/words"
}

test_shared_library() {
	version=$("$prefix/bin/edgewise-gen" --version | sed 's/gen //')
	library=$prefix/lib/libedgewise.so.$version
	abi=$(echo "$version" | sed 's/^\(0\.[0-9]*\|[0-9]*\).*/\1/')
	verdict 'the shared library exports what the header declares' "$(
		declared >"$work/declared"
		nm -D --defined-only "$library" >"$work/exported"
		sed -n "s/.* [TD] \(.*\)@@EDGEWISE_$abi$/\1/p" "$work/exported" | sort |
			diff "$work/declared" - | sed -n 2p
		grep -m 1 -v -e "@@EDGEWISE_$abi$" -e " A EDGEWISE_$abi$" "$work/exported")"
	verdict "its name is libedgewise.so.$abi" "$(
		readelf -dW "$library" | grep -q "SONAME.*\[libedgewise\.so\.$abi\]" || echo "no"
		for link in "$abi" ''; do
			[ "$(readlink "$prefix/lib/libedgewise.so${link:+.$link}")" = \
				"libedgewise.so.$version" ] || echo "no link $link"
		done)"
	for program in 'area pkg-config/main' 'area find-package/build/main'; do
		[ -x "$projects/$program" ] || continue
		verdict "$program needs it" "$(readelf -dW "$projects/$program" |
			grep -q "NEEDED.*\[libedgewise\.so\.$abi\]" || echo "no")"
	done
	verdict "version $version everywhere" "$(
		[ "$(pkg-config --modversion edgewise)" = "$version" ] || echo "not pkg-config's"
		grep -q "EW_VERSION \"$version\"" "$prefix/include/edgewise.h" || echo "not the header's"
		for asked in "$abi" "$version"; do
			accepts "$asked" || echo "CMake's package refuses $asked"
		done
		for asked in "${version%.*}.999" 999 "$((${abi%%.*} + 1)).0"; do
			! accepts "$asked" || echo "CMake's package accepts $asked"
		done)"
}

# VERSION: would find_package take this one for it?
accepts() {
	cat >"$work/version.cmake" <<-END
		set(PACKAGE_FIND_VERSION $1)
		include("$prefix/lib/cmake/edgewise/edgewise-config-version.cmake")
		if(NOT PACKAGE_VERSION_COMPATIBLE)
			message(FATAL_ERROR no)
		endif()
	END
	cmake -P "$work/version.cmake" 2>/dev/null
}

# ---- a single header ----

STRICT='-Wall -Wextra -Wpedantic -Wconversion -Wshadow'

SECONDS_ALLOWED=45          # promised: 15 on one core; a loaded machine gets three times that

# COMPILER FLAGS...: the header of default contents, strictly, and how long that takes the compiler
single_header() {
	has "$1" || { skip "single header, $*" "not installed"; return; }
	problem=$("$@" $STRICT -O2 -c -o "$work/single.o" "$work/single.c" 2>&1 |
		grep -E -m 1 'error|warning'
		times >"$work/times")
	seconds=$(awk 'END { split($1, t, /[ms]/); print int(60 * t[1] + t[2]) }' "$work/times")
	[ -n "$problem" ] || [ "$seconds" -le $SECONDS_ALLOWED ] || problem="allowed $SECONDS_ALLOWED"
	verdict "single header, $*, $seconds s" "$problem"
}

test_single_header() {
	"$build/gen" --quiet --single-header "$work/edgewise.h" || exit 1
	printf '#define EW_IMPLEMENTATION\n#include "edgewise.h"\n' >"$work/single.c"
	for compiler in gcc clang; do
		single_header $compiler -std=c99
	done
	for compiler in g++ clang++; do
		single_header $compiler -x c++ -std=c++17
	done
}

if [ $# -gt 0 ]; then
	for name; do
		way "$name"
	done
	finish
	exit
fi
for file in "$tests"/vendor/*/*.commands; do
	name=${file#"$tests/vendor/"}
	way "${name%.commands}"
done
test_rebuilding
[ ! -d "$prefix" ] || test_shared_library
[ ! -d "$prefix" ] || test_staging
test_single_header
finish

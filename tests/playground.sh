#!/bin/sh
# playground.sh - the page of examples/playground, in Chromium.
#
#     sh tests/playground.sh BUILD
#
# playground.mjs moves its points by mouse, finger and keys and holds what the page says against the
# library itself, which playground.c asks; it leaves screenshots in BUILD/playground.

. "$(dirname "$0")/verdict.sh"
build=$(cd "$1" && pwd)

missing=
has node || missing=node
has chromium || missing=chromium
[ -d "$build/playground/node_modules/playwright-core" ] || missing=playwright-core
[ -s "$build/playground/index.html" ] || missing="the page, which needs clang, lld and wasi-libc"
if [ -n "$missing" ]; then
	skip playground "no $missing (make deps-playground installs what it needs)"
	finish
	exit
fi
CHROMIUM=$(command -v chromium) node "$tests/playground.mjs" "$build" >"$work/log" 2>&1 ||
	verdict playground "ended early: $(tail -n 1 "$work/log")"
grep -E '^(ok|not ok) ' "$work/log" >"$work/verdicts"
grep -Ev '^(ok|not ok) ' "$work/log"
replay "$work/verdicts"
finish

#!/bin/sh
# pack.sh WASM - the page as one file, to stdout: what index.html links to is put in its place, and
# kernels.js, which nobody wrote, is the WASM, compressed, in base64. So it opens from a disk too,
# where browsers fetch nothing.
set -eu
here=$(dirname "$0")
wasm=$1

while IFS= read -r line; do
	case $line in
	'<link rel="stylesheet" href="'*)
		name=${line#*href=\"}
		echo '<style>'
		cat "$here/${name%%\"*}"
		echo '</style>'
		;;
	'<script src="kernels.js"></script>')
		printf "<script>\nconst KERNELS = '%s';\n</script>\n" "$(gzip -9nc "$wasm" | base64 | tr -d '\n')"
		;;
	'<script src="'*)
		name=${line#*src=\"}
		echo '<script>'
		cat "$here/${name%%\"*}"
		echo '</script>'
		;;
	*)
		printf '%s\n' "$line"
		;;
	esac
done <"$here/index.html"

#!/bin/sh
# layers.sh - no object of gen refers to a symbol that a later one in the order
# of the pipeline defines.
#
#     sh tests/layers.sh BUILD "util rational polynomial ..."     (the variable GEN of the Makefile)
#
# What embed.c makes of the runtime is data for bundle alone, and what it makes of filter files for
# filter. Two tests show that the check can fail: the reversed order must be reported, and so must
# the first object if it is moved behind the last one.
set -u
build=${1:-build}
order=${2:?the objects in the order of the pipeline}
. "$(dirname "$0")/verdict.sh"
missing=

# upward ORDER: one line per reference to a later object
upward() {
	for object in $1; do
		echo "object $object"
	done | awk '
		$1 == "object" { rank[$2] = ++count; next }
		$3 != "U"      { owner[$2] = $1; next }
		               { user[++uses] = $1; symbol[uses] = $2 }
		END {
			for (i = 1; i <= uses; i++) {
				definer = owner[symbol[i]]
				if (rank[definer] > rank[user[i]])
					print user[i] " refers upwards to " symbol[i] " of " definer
			}
		}' - "$work/symbols"
}

for object in $order; do                              # "object symbol type"
	[ -f "$build/obj/$object.o" ] || missing="$object.o is missing"
	nm -P -g "$build/obj/$object.o" | awk -v object="$object" '{ print object, $1, $2 }'
done >"$work/symbols"

backwards='' first='' rest=''
for object in $order; do
	backwards="$object $backwards"
	if [ -z "$first" ]; then first=$object; else rest="$rest $object"; fi
done

verdict "layers of gen" "${missing:-$(upward "$order" | head -n 1)}"
for table in 'runtime bundle' 'filters filter'; do
	verdict "embedded ${table% *}" "$(awk -v table="embedded_${table% *}" -v user="${table#* }" '
		$2 == table && $1 != user { print $1 " refers to it" }' "$work/symbols")"
done
verdict "reversed order is reported" "$([ -n "$(upward "$backwards")" ] || echo "it was not")"
verdict "$first at the end is reported" \
	"$(upward "$rest $first" | grep -q "refers upwards to [a-z_]* of $first\$" ||
		echo "it was not")"
finish

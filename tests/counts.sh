#!/bin/sh
# counts.sh - recounts operations from the emitted text.
#
#     sh tests/counts.sh [BUILD]
#
# fma(, *, binary + and binary - in the loop body of every ring kernel, and in every single-edge
# function, against the comment above it, the manifest and the list in edgewise_kernels.h;
# the moments of the fma target also against the promised bars (vector targets print its program). Loads and loop headers are not
# operations, nor is the sign inside a constant or before an operand.
set -u
build=${1:-build}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

cat >"$work/counts.awk" <<'END'
BEGIN {                                              # all moments to degree N, FMA pipe and adds
	split("0 2 2|1 4 4|2 12 8|3 18 14|4 33 15|6 81 22|8 139 37", bars, "|")
	for (i in bars) {
		split(bars[i], part, " ")
		most_pipe["moments_" part[1]] = part[2]
		most_add["moments_" part[1]] = part[3]
	}
}

function fail(name, why) { print "not ok " name ": " why; failed++; bad = 1 }

function expect(name, where, said, counted) {
	if (said != counted)
		fail(name, where " says " said ", counted " counted)
}

# The integer after "key": in a line of JSON.
function value(json, key) {
	if (!match(json, "\"" key "\": [0-9]+"))
		return "none"
	return substr(json, RSTART + length(key) + 4, RLENGTH - length(key) - 4)
}

function json_cost(json, target) {
	if (!sub(".*\"" target "\": [{]", "", json))
		return "none"
	return value(json, "mul") " mul " value(json, "fma") " fma " value(json, "add") " add"
}

# Sets mul, fma, add.
function count(body) {
	gsub(/\/\*[^*]*\*\//, "", body)
	gsub(/0x[0-9a-f.]+p[-+][0-9]+f?/, "1", body)
	gsub(/return/, "=", body)
	fma = gsub(/fmaf?\(/, "(", body)
	mul = gsub(/\*/, ",", body)
	add = gsub(/[]A-Za-z0-9_)][ \t]*[-+]/, ",", body)
}

function check_ring(kernel, ring, target) {
	count(body)
	expect(kernel, "the comment", comment, mul + fma " and " add)
	expect(kernel, "the manifest", json_cost(rings[ring], target),
		mul " mul " fma " fma " add " add")
	expect(kernel, "the list", listed[kernel], mul + fma " and " add)
	if (target == "fma" && ring in most_pipe &&
	    (mul + fma > most_pipe[ring] || add > most_add[ring]))
		fail(kernel, mul + fma " + " add " operations, promised " \
			most_pipe[ring] " + " most_add[ring])
	kernels++
}

function check_edge(name, edge) {
	count(body)
	expect(name, "the comment", comment, mul " and " add)
	expect(name, "the manifest", json_cost(edges[edge], "portable"),
		mul " mul " fma " fma " add " add")
	kernels++
}

function close_file() {
	if (file && kernels == 0)
		fail(file, "no kernel found")
	if (file && !bad) {
		print "ok counts of " file ", " kernels " kernels"
		passed++
	}
	seen += kernels
	kernels = bad = 0
}

/"ring": / {
	match($0, /"ring": "[^"]*/)
	rings[substr($0, RSTART + 9, RLENGTH - 9)] = $0
	expected += 4
}
/"function": / {
	match($0, /ew_line_[^"]*/)
	edges[substr($0, RSTART, RLENGTH)] = $0
	expected += 2
}
/X\(EW_RING_[A-Z0-9_]*, ew_ring_[a-z0-9_]*, [0-9]+, [0-9]+\)/ {
	split($0, part, /[,()] */)
	listed[part[3]] = part[4] " and " part[5]
}
FNR == 1 {
	close_file()
	file = FILENAME ~ /\.c$/ ? FILENAME : ""
	sub(/.*\//, "", file)
	is_float = FILENAME ~ /(linef|f_portable|f_fma)[0-9_]*\.c$/
}
/^ \* Cost( per item)?: / {
	split($0, part, /(: | mul| or fma|, | add)+/)
	comment = part[2] " and " part[3]
}
/void ew_ring_.*\(/ { match($0, /ew_ring_[a-z0-9_]+/); kernel = substr($0, RSTART, RLENGTH) }
/^(double|float) ew_line_/ {
	match($0, /ew_line_[a-z0-9_]+/)
	kernel = substr($0, RSTART, RLENGTH)
	inside = 2
	body = ""
	next
}
/^\t\tfor \(size_t i = / { inside = 1; first = 1; body = ""; next }
/^\t\t\tif \(count - i > / { first = 0 }               # the next item of the lane: the same again
inside == 1 && /^\t\t}/ {
	ring = target = kernel
	sub(/.*_/, "", target)
	gsub(/^ew_ring_|_[a-z]*$/, "", ring)
	if (is_float)
		sub(/f$/, "", ring)
	check_ring(kernel, ring, target)
	inside = 0
}
inside == 2 && /^}/ {
	edge = kernel
	if (is_float)
		sub(/f$/, "", edge)
	check_edge(kernel, edge)
	inside = 0
}
inside && (first || inside == 2) && !/ = [xy]\[i/ { body = body $0 }

END {
	close_file()
	if (seen != expected || seen == 0)
		fail("all kernels", seen " found, the manifest has " expected \
			" in two precisions and two targets")
	print passed + 0 " passed, " failed + 0 " failed"
	exit failed > 0
}
END

counts() {
	awk -f "$work/counts.awk" "$1/edgewise_manifest.json" "$1/edgewise_kernels.h" \
		"$1"/edgewise_line*.c "$1"/edgewise_*_portable*.c "$1"/edgewise_*_fma*.c
}

# One operation more in one kernel must be noticed.
cp -r "$build/emitted" "$work/broken" && sed '1,/acc0 = fma(s/s/acc0 = fma(s/acc0 = acc0 + fma(s/' \
	"$build/emitted/edgewise_integrands_fma.c" >"$work/broken/edgewise_integrands_fma.c"
if counts "$work/broken" >"$work/log" || ! grep -q '^not ok ew_ring_x1y0_fma: ' "$work/log"; then
	echo "not ok self-test: an operation more in ew_ring_x1y0_fma was not noticed"
	echo "0 passed, 1 failed"
	exit 1
fi
counts "$build/emitted"

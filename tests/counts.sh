#!/bin/sh
# counts.sh - recounts operations from the emitted text.
#
#     sh tests/counts.sh [BUILD]
#
# Multiplications, fused operations and additions in every single-edge function and in every loop
# of every ring kernel, against the comment above it, the manifest and the list in
# edgewise_kernels.h. A loop says in its header how many items it takes at a time: a kernel has up
# to three (vectors shifted into place, whole vectors, the rest; of curves and filters just one),
# and the vertex form and the stored shape take two items at a time; an item that batches use alone
# is a function. Deposits have one loop over pieces. Moments on targets with FMA are also held
# against the promised bars. Scalar targets spell operations as C operators, vector targets as
# intrinsics. Loads, stores and loop headers are not operations, nor is the sign inside a constant
# or before an operand. A minimum, a maximum or a choice costs an addition, rounding to a multiple
# two. An absolute value costs nothing; there must be as many of them as in the kernel of the scalar
# target that runs the same program: fma, or portable for wasm128. What ew_ring_lost takes is counted
# in the list, where it stands.
set -u
build=${1:-build}
. "$(dirname "$0")/verdict.sh"

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

# Programs with constants that are not rational differ between the precisions.
function json_cost(json, target) {
	if (is_float && json ~ "\"" target "_float\"")
		target = target "_float"
	if (!sub(".*\"" target "\": [{]", "", json))
		return "none"
	return value(json, "mul") " mul " value(json, "fma") " fma " value(json, "add") " add " \
		value(json, "div") " div"
}

function cost() { return mul " mul " fma " fma " add " add " divide " div" }

# As the comments say it, and the list without divisions.
function pipes() { return mul + fma " and " add }

# Add to mul, fma, add, absolute.
function count_scalar(text) {
	lost = gsub(/ew_ring_lostf?\(/, "(", text)
	fma += gsub(/fmaf?\(/, "(", text)
	add += gsub(/ew_ring_(max|min|choose|exponent|fraction)f?\(/, "(", text)
	divide += gsub(/sqrtf?\(/, "(", text) + gsub(/\//, ",", text)
	absolute += gsub(/fabsf?\(/, "(", text)
	mul += gsub(/\*/, ",", text) + lost * lost_mul
	add += gsub(/[]A-Za-z0-9_)][ \t]*[-+]/, ",", text) + lost * lost_add
}

function count_vector(text) {
	lost = gsub(/ew_ring_lost_f/, "(", text)
	absolute += gsub(/EW_ABS_mm|vabsq_f|wasm_f[0-9x]*_abs/, "(", text)
	divide += gsub(/_div_p|EW_SQRT_mm|v(div|sqrt)q_|wasm_f[0-9x]*_(div|sqrt)/, "(", text)
	add += gsub(/EW_(MAX|MIN|CHOOSE|EXPONENT|FRACTION)_|wasm_f[0-9x]*_p(min|max)/, "(", text)
	fma += gsub(/_fn?m(add|sub)_p|vfm[as]q_f/, "(", text)
	mul += gsub(/_mul_p|vmulq_|wasm_f[0-9x]*_mul/, "(", text) + lost * lost_mul
	add += gsub(/_(add|sub)_p|v(add|sub)q_|wasm_f[0-9x]*_(add|sub)/, "(", text) + lost * lost_add
	stray += gsub(/[]A-Za-z0-9_)] [-+*\/] |_(min|max)[_(]|v(max|min)q/, "(", text)
}

function count(body, vector) {
	mul = fma = add = divide = absolute = stray = 0
	gsub(/\/\*[^*]*\*\//, "", body)
	gsub(/0x[0-9a-f.]+p[-+][0-9]+f?/, "1", body)
	gsub(/return/, "=", body)
	gsub(/if \([^)]*\) [{]/, "", body)
	gsub(/out\[[^]]*\]/, "out", body)
	statements = split(body, statement, ";")
	for (at = 1; at <= statements; at++) {
		if (vector && statement[at] !~ /loadu|storeu|vld1q|vst1q|v128_(load|store)|pad|size_t|mask|EW_HIDE/)
			count_vector(statement[at])
		else if (!vector && statement[at] !~ / = ([xy]\[i|\*\([xy] )/)
			count_scalar(statement[at])
	}
}

# The scalar target that runs the program of this one.
function scalar_of(target) { return target ~ /portable|wasm128/ ? "portable" : "fma" }

# One loop of a ring or deposit, which takes `items` at a time.
function check_loop(kernel, ring, target) {
	vector = target !~ /portable|fma/
	scalar = scalar_of(target)
	count(body, vector)
	where = kernel ", loop " ++loops
	if (!(ring in rings))
		fail(where, "not in the manifest")
	if (stray || mul % items || fma % items || add % items || divide % items || absolute % items)
		fail(where, mul " mul " fma " fma " add " add " absolute " absolute " stray \
			" stray in " items " items")
	mul /= items; fma /= items; add /= items; divide /= items; absolute /= items
	if (!vector)
		absolutes[ring, target] = absolute
	expect(where, "the comment", comment, pipes() " and " divide)
	expect(where, "the manifest", json_cost(rings[ring], scalar), cost())
	expect(where, "the list", listed[kernel], pipes())
	if (vector)
		expect(where, "target " scalar, absolutes[ring, scalar] " absolute",
			absolute " absolute")
	if (scalar == "fma" && ring in most_pipe &&
	    (mul + fma > most_pipe[ring] || add > most_add[ring]))
		fail(where, mul + fma " + " add " operations, promised " \
			most_pipe[ring] " + " most_add[ring])
}

# Each kernel must have been through its loops: one, or whole vectors and the rest.
function close_kernel() {
	if (kernel && loops < (kernel ~ /_(portable|fma)$|_(quad|conic|cubic|deposit)_/ ||
	    rings[ring] ~ /"family": "filter"/ ? 1 : 2))
		fail(kernel, loops " loops found")
	kernel = ""
	kernels++
	all_loops += loops
}

# An item alone, for vectors that are in registers already.
function check_item(kernel, ring, target) {
	count(body, 1)
	if (stray || absolute)
		fail(kernel, absolute " absolute " stray " stray")
	expect(kernel, "the manifest", json_cost(rings[ring], scalar_of(target)), cost())
	items_seen++
	all_loops++
}

function check_edge(name, edge) {
	count(body, 0)
	expect(name, "the comment", comment, mul " and " add " and " divide)
	expect(name, "the manifest", json_cost(edges[edge], "portable"), cost())
	kernels++
	all_loops++
}

function close_file() {
	if (file && kernels + items_seen == 0)
		fail(file, "no kernel found")
	if (file && !bad) {
		print "ok counts of " file ", " kernels " kernels, " all_loops " loops or bodies"
		passed++
	}
	seen += kernels
	kernels = all_loops = items_seen = bad = 0
}

/"ring": / {
	match($0, /"ring": "[^"]*/)
	rings[substr($0, RSTART + 9, RLENGTH - 9)] = $0
	expected += 12
}
/"deposit": / {
	match($0, /"deposit": "[^"]*/)
	rings[substr($0, RSTART + 12, RLENGTH - 12)] = $0
	expected += 6
}
/"function": / {
	match($0, /ew_(line|quad|cubic)_[^"]*/)
	edges[substr($0, RSTART, RLENGTH)] = $0
	expected += 2
}
/X\((EW_RING|ew_filter)_[A-Za-z0-9_]*, ew_(ring|deposit)_[a-z0-9_]*, [0-9]+, [0-9]+\)/ {
	split($0, part, /[,()] */)
	listed[part[3]] = part[4] " and " part[5]
}
FNR == 1 {
	close_file()
	file = FILENAME ~ /\.c$|_items_/ ? FILENAME : ""
	sub(/.*\//, "", file)
	is_float = file ~ /(linef|f_(portable|fma|avx2|avx512|neon|wasm128))[0-9_]*\.c$/
}
/^ \* Cost( per item| per piece)?: / {
	split($0, part, /(: | mul| or fma|, | add)+/)
	comment = part[2] " and " part[3] " and " ($0 ~ / div or sqrt/ ? part[4] + 0 : 0)
}
/void ew_ring_[a-z0-9_]*\($|void ew_deposit_[a-z0-9_]*\(/ {
	match($0, /ew_(ring|deposit)_[a-z0-9_]+/)
	kernel = substr($0, RSTART, RLENGTH)
	ring = target = kernel
	sub(/.*_/, "", target)
	gsub(/^ew_(ring_)?|_[a-z0-9]*$/, "", ring)
	if (is_float)
		sub(/f$/, "", ring)
	loops = 0
}
/EW_INLINE void ew_ring_[a-z0-9_]*_item_/ {
	match($0, /ew_ring_[a-z0-9_]+/)
	item = substr($0, RSTART, RLENGTH)
	ring = item
	gsub(/^ew_ring_|_item_.*/, "", ring)
	target = item
	sub(/.*_item_/, "", target)
	inside = 4
	body = ""
}
/ew_ring_lost\(double/ { kernel = "ew_ring_lost"; body = ""; inside = 3; next }
/^(double|float) ew_(line|quad|cubic)_/ {
	match($0, /ew_[a-z0-9_]+/)
	kernel = substr($0, RSTART, RLENGTH)
	inside = 2
	body = ""
	next
}
/^\tfor \(size_t pass = 0; / {
	width = $0
	gsub(/.* pass \+= |\).*/, "", width)
}
/^\t+for \(.*; i \+= .*\) [{]$/ {
	items = $0
	gsub(/.* i \+= |\) [{]$/, "", items)
	if (items == "step" || kernel ~ /^ew_deposit/)
		items = 1
	else
		items = items == "2 * step" ? 2 : items / width
	end = $0
	sub(/for.*/, "}", end)
	inside = 1
	body = ""
	next
}
inside == 1 && $0 == end {
	check_loop(kernel, ring, target)
	inside = 0
}
inside == 2 && /^}/ {
	edge = kernel
	if (is_float)
		sub(/f$/, "", edge)
	check_edge(kernel, edge)
	inside = 0
	kernel = ""
}
inside == 3 && /^}/ {
	count(body, 0)
	lost_mul = mul
	lost_add = add
	inside = 0
	kernel = ""
}
inside == 4 && /^}/ {
	sub(/^[^{]*[{]/, "", body)
	check_item(item, ring, target)
	inside = 0
}
/^}/ && file && kernel ~ /^ew_(ring|deposit)/ { close_kernel() }
inside { body = body $0 }

END {
	close_file()
	if (seen != expected || seen == 0)
		fail("all kernels", seen " found, the manifest has " expected \
			" in two precisions and six targets, deposits in one")
	print passed + 0 " passed, " failed + 0 " failed"
	exit failed > 0
}
END

# The scalar targets come first: what vectors do is compared with them.
counts() {
	folder=$1
	set -- "$folder"/edgewise_line*.c
	for target in portable fma avx2 avx512 neon wasm128; do
		for group in moments curves distance coverage filters deposit trust integrands; do
			set -- "$@" "$folder/edgewise_$group"*"_$target"*.c
		done
	done
	set -- "$@" "$folder"/edgewise_items_*.h
	awk -f "$work/counts.awk" "$folder/edgewise_manifest.json" \
		"$folder/edgewise_kernels.h" "$@"
}

# notices KERNEL FILE SED: one operation more or less in one loop must be noticed.
notices() {
	sed "$3" "$build/emitted/$2" >"$work/broken/$2"
	if counts "$work/broken" >"$work/log" || ! grep -q "^not ok $1[,:]" "$work/log"; then
		echo "not ok self-test: a wrong operation in $1 was not noticed"
		echo "0 passed, 1 failed"
		exit 1
	fi
	cp "$build/emitted/$2" "$work/broken/$2"
}

cp -r "$build/emitted" "$work/broken"
notices ew_ring_x1y0_fma edgewise_integrands_fma.c \
	'1,/acc0 = fma(s/s/acc0 = fma(s/acc0 = acc0 + fma(s/'
notices ew_ring_moments_1_avx512 edgewise_moments_avx512.c \
	'/moments_1_avx512(/,/mul_pd/s/_mm512_mul_pd(x0, y1)/_mm512_add_pd(x0, y1)/'
notices ew_ring_moments_6_neon edgewise_moments_neon.c \
	'/moments_6_neon(/,/_2 = vaddq/s/s_2 = vsubq_f64(t0_2, t1_2)/s_2 = t0_2/'
notices ew_ring_moments_1_item_avx2 edgewise_items_avx2.h \
	'1,/add_pd(x0/s/_mm256_add_pd(x0, x1)/x0/'
notices ew_ring_magnitudes_0f_avx2 edgewise_trustf_avx2.c \
	'1,/EW_ABS/s/EW_ABS_mm256_ps(\([a-z0-9]*\))/\1/'
notices ew_ring_coveragef_neon edgewise_coveragef_neon.c \
	'1,/EW_MIN/s/EW_MIN_f32(t1, u1)/t1/'
notices ew_ring_compensated_wasm128 edgewise_trust_wasm128.c \
	'/compensated_wasm128(/,/lost_f/s/ew_ring_lost_f64x2(\([a-z0-9]*\), .*)/\1/'
notices ew_ring_mitchell_avx2 edgewise_filters_avx2_2.c \
	'/ring_mitchell_avx2(/,/_max_\|EW_MAX/s/EW_MAX_mm256_pd(\([a-z0-9]*\), .*)/\1/'
notices ew_deposit_tent_portable edgewise_deposit_portable.c \
	'/deposit_tent_portable/,/12582912/s/(\(t[0-9]*\) + 12582912.0f) - 12582912.0f/\1/'
counts "$build/emitted"

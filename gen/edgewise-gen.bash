# edgewise-gen.bash - completion of edgewise-gen's command line in bash.
#
# Source it, or install it as share/bash-completion/completions/edgewise-gen. For the program in the
# source tree: complete -F _edgewise_gen gen
#
# The words of lists, the schemes and the filters are asked of the program itself. An option and its
# value may be two words or joined by =, which bash parts unless COMP_WORDBREAKS says otherwise.

# NAME: the words that --list has under this name.
_edgewise_gen_words() {
	"${COMP_WORDS[0]/#\~/$HOME}" --list 2>/dev/null | awk -v name="$1:" '
		$1 == name { $1 = ""; print; inside = NF == 1; next }
		/^ / && inside { print $1; next }
		{ inside = 0 }'
}

# CURRENT WORDS: completes the last part of a list with commas; no word twice.
_edgewise_gen_list() {
	local done= word
	[[ $1 == *,* ]] && done=${1%,*},
	for word in $2; do
		[[ ,$done == *,$word,* ]] || COMPREPLY+=($(compgen -W "$done$word" -- "$1"))
	done
	compopt -o nospace 2>/dev/null
}

_edgewise_gen() {
	local current=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} joined=
	local IFS=$' \t\n' # names of files may have blanks
	COMPREPLY=()
	if [[ $current == --*=* ]]; then
		option=${current%%=*}
		joined=$option=
		current=${current#*=}
	elif [[ $current == = ]]; then
		current=
	elif [[ $option == = ]]; then
		option=${COMP_WORDS[COMP_CWORD - 2]}
	fi
	case $option in
	--families | --edges | --targets)
		_edgewise_gen_list "$current" "$(_edgewise_gen_words "${option#--}")" ;;
	--precision)
		_edgewise_gen_list "$current" "$(_edgewise_gen_words precisions)" ;;
	--scheme)
		COMPREPLY=($(compgen -W "$(_edgewise_gen_words schemes)" -- "$current")) ;;
	--format)
		COMPREPLY=($(compgen -W 'text json latex c' -- "$current")) ;;
	--filter | --show)
		IFS=$'\n'
		compopt -o filenames 2>/dev/null
		COMPREPLY=($(compgen -W "$(_edgewise_gen_words filters)" -- "$current")
			$(compgen -f -- "$current")) ;;
	--out)
		IFS=$'\n'
		compopt -o filenames 2>/dev/null
		COMPREPLY=($(compgen -d -- "$current")) ;;
	--single-header | --manifest | --depfile)
		IFS=$'\n'
		compopt -o filenames 2>/dev/null
		COMPREPLY=($(compgen -f -- "$current")) ;;
	--max-degree | --monomial | --polynomial | --prefix | -d)
		;;
	*)
		COMPREPLY=($(compgen -W '--max-degree --families --monomial --polynomial --filter
			--edges --precision --targets --scheme --prefix --out --no-runtime
			--single-header --manifest --depfile --check --dry-run --show --format -d
			--list --quiet --verbose --help --version' -- "$current")) ;;
	esac
	COMPREPLY=("${COMPREPLY[@]/#/$joined}")
}

complete -F _edgewise_gen edgewise-gen

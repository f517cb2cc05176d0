#!/usr/bin/env bash
# Pages stay short and texts keep to the words of the field. Each page has a budget in words, the changelog one in lines, and
# help, manual pages, pages and lists of parameters use none of the words that readers could not search for.
# usage: words.sh PROGRAM SOURCE_TREE
set -u
program=$1
texts=$PWD/texts
cd "$2" || exit 1
status=0
wrong() { echo "$*"; status=1; }

# Words have a letter or a digit: bars of tables and comments do not count.
words_of() { cat "$@" | sed 's/<!--[^>]*-->//g' | tr -s ' \t' '\n' | grep -c '[A-Za-z0-9]'; }

# within WORDS PAGE...
within() {
  local most=$1 page words
  shift
  for page in "$@"; do
    words=$(words_of "$page")
    [ "$words" -le "$most" ] || wrong "$page has $words words: at most $most"
  done
}
# A page describes one task, in 900 words; explanations, references, papers and tutorials have budgets of their own. Pages that programs
# write from tables of the program have none.
declare -A budget=([README.md]=600 [docs/performance.md]=1200)
for page in architecture choosing integrators lab lighting-accuracy mitsuba models radiance reliability scenes view-factors measures; do
  budget[docs/$page.md]=1500
done
generated='docs/keys.md docs/options.md docs/sets.md docs/gallery.md'
for page in README.md docs/*.md docs/papers/*.md; do
  case " $generated " in *" $page "*) continue ;; esac
  case $page in docs/papers/*) usual=1500 ;; *) usual=900 ;; esac
  within "${budget[$page]:-$usual}" "$page"
done
# shellcheck disable=SC2086
all=$(words_of docs/*.md docs/*/*.md) written=$(words_of $generated)
[ $((all - written)) -le 30000 ] || wrong "docs/ has $((all - written)) words without generated pages: at most 30000"

awk '/^## / { release = $0; lines = 0 }
  /^- / { if (++lines == 61) { print "CHANGELOG.md: more than 60 lines in " release; bad = 1 }
          words = NF - 1; if (words > 25) { print "CHANGELOG.md:" NR ": " words " words: at most 25"; bad = 1 } }
  END { exit bad }' CHANGELOG.md || status=1

{
  "$program" help
  "$program" help command --format csv | tail -n +2 | cut -d, -f1 | while read -r name; do "$program" help "$name"; done
  for page in aureole scene names; do "$program" manual "$page"; done
} >"$texts" || wrong "aureole help fails"
banned='pictures?|verbs?|rivals?|wish(ed|es)?|anew|is wanted|is asked|are asked|asked for|as asked|is told|are told|beside|what there is|samples a pixel|does not go with|one.s own|nothing but|who (looks|asks|names)'
grep -nwiE "$banned" "$texts" && wrong "help or manual: words to replace, in the lines above"
for page in README.md docs/*.md docs/papers/*.md packaging/*.md; do # without code and addresses
  sed -e 's/`[^`]*`//g; s/\](\([^)]*\))/]/g; s/^    .*//' "$page" | grep -nwiE "$banned" && wrong "$page: words to replace, in the lines above"
done
rm -f "$texts"
exit $status

#!/usr/bin/env bash
# Pages stay short and texts keep to the words of the field. Each page has a budget in words, the changelog one in lines, and
# help, manual pages and lists of parameters use none of the words that readers could not search for.
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
within 600 README.md
# Explanations and references; every other page describes one task.
long='docs/architecture.md docs/choosing.md docs/compared.md docs/domains.md docs/guide.md docs/images.md docs/measures.md docs/mitsuba.md docs/reliability.md docs/scenes.md docs/sets.md docs/sets-compared.md docs/integrals.md docs/integrators.md docs/lab.md docs/rendering.md docs/view-factors.md'
generated='docs/keys.md docs/options.md'
# shellcheck disable=SC2086
within 1500 $long docs/papers/*.md
within 1200 docs/performance.md docs/glossary.md
for page in docs/*.md; do
  case " $long $generated docs/performance.md docs/glossary.md " in
    *" $page "*) ;;
    *) within 900 "$page" ;;
  esac
done
# shellcheck disable=SC2086
all=$(words_of docs/*.md docs/*/*.md) known=$(words_of $generated)
[ $((all - known)) -le 40000 ] || wrong "docs/ has $((all - known)) words without generated pages: at most 40000"

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
rm -f "$texts"
exit $status

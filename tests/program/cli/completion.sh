#!/usr/bin/env bash
# Shell completion: what the program offers, bash's completions as bash itself asks for them, and scripts that the other
# shells can read.
set -u
aureole=$1
status=0
fail() {
  echo "FAILED: $*"
  status=1
}
PATH=$(dirname "$aureole"):$PATH
rm -rf ./*
mkdir folder
: >scene.xml

# offers WORD WORDS...: the word is among what the last word may become.
offers() {
  local wanted=$1
  shift
  aureole completion words -- "$@" | cut -f1 | grep -qxF -- "$wanted" || fail "aureole $*: no '$wanted'"
}
# silent WORDS...: nothing may stand there.
silent() { [ -z "$(aureole completion words -- "$@")" ] || fail "aureole $*: offers $(aureole completion words -- "$@" | head -3)"; }
offers render r
offers measure measure
offers --samples render --s
offers --help lab --
offers sphere points --domain ''
offers --domain=sphere points --domain=
offers --metric=energy,star measure --metric=energy,s
offers spherical-fibonacci points spher
offers :file measure ''
offers sobol measure ''
offers finalgather:photons=4,debias=only render a.xml --integrator finalgather:photons=4,debias=
offers path:hide_emitters=true render --integrator path:hide_emitters=
if aureole help lab-integrator >/dev/null 2>&1; then
  offers finalgather-lab render --integrator finalgather-
  offers finalgather-lab:component=diffuse render --integrator finalgather-lab:component=d
fi
offers phong: points --lobe p
offers :folder lab run -o ''
offers :file render -qo ''
offers run lab ''
offers marques-2018-table1 lab run marques-2018-gains marques-2018-t
offers bsdf help ''
offers dielectric help bsdf d
offers weights help command w
silent points --seed ''
silent no-such-verb ''
silent points -- --d
# Every command, option and choice that help knows.
aureole help command --format csv | tail -n +2 | cut -d, -f1 >verbs
while read -r verb; do
  offers "$verb" "$verb"
  aureole help command "$verb" --format csv | tail -n +2 | grep -oE -- '--[a-z0-9-]*[a-z0-9]' | while read -r option; do
    offers "$option" "$verb" "$option"
  done
done <verbs

# completes WORDS REPLY...: bash's own variables, its words broken at : and =.
# shellcheck disable=SC1090
source <(aureole completion bash)
complete -p aureole | grep -q -- '-F _aureole' || fail "bash knows no completion"
completes() {
  local -a reply=("${@:2}")
  # shellcheck disable=SC2206
  COMP_WORDS=($1)
  [[ $1 != *' ' ]] || COMP_WORDS+=('')
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _aureole aureole "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
  [ "${COMPREPLY[*]}" = "${reply[*]}" ] || fail "bash: '$1' completes to '${COMPREPLY[*]}', not '${reply[*]}'"
}
COMP_WORDBREAKS=$' \t\n"\'><=;|&(:'
completes 'aureole ren' render
completes 'aureole completion ' bash zsh fish
completes 'aureole render sc' scene.xml
completes 'aureole render --output = sc' scene.xml
completes 'aureole lab run -o fol' folder
completes 'aureole points --density ' same optimal
completes 'aureole points --density = ' same optimal
completes 'aureole points --density =' same optimal
completes 'aureole render --integrator finalgather : photons = 4,deb' 4,debias=
completes 'aureole render --integrator finalgather : photons = 4,direct = n' nee none
COMP_WORDBREAKS=$' \t\n"\'><;|&('
completes 'aureole points --density=o' --density=optimal

for shell in zsh fish; do
  aureole completion $shell >script || fail "completion $shell"
  [ -s script ] || fail "no script of $shell"
  if command -v $shell >/dev/null; then
    $shell -n script || fail "$shell does not read its script"
  fi
done
if command -v fish >/dev/null; then
  [ "$(HOME=$PWD fish -c "source script; complete -C 'aureole render --output=sce'")" = --output=scene.xml ] || fail "fish: files"
  [ "$(HOME=$PWD fish -c "source script; complete -C 'aureole points --density opt'" | cut -f1)" = optimal ] || fail "fish: choices"
fi
aureole completion csh 2>message && fail "a shell that is not known"
grep -q "bash, zsh or fish" message || fail "completion csh: $(cat message)"
exit $status

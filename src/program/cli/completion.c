/* aureole completion: scripts for completion in shells. The scripts run this program to get the candidates,
 * so that they need not change with its options. */
#include <stdio.h>
#include <string.h>

#include "program/cli/listing.h"

/* bash breaks words at ':' and '=': the script joins them for the query and removes the prefix that bash
 * keeps from the candidates. */
static const char bash_script[] =
    "# Completion of aureole for bash: source <(aureole completion bash)\n"
    "_aureole() {\n"
    "  local breaks=${COMP_WORDBREAKS//[^:=]/} word line part kept\n"
    "  local -a words=() lines=() files=()\n"
    "  breaks=\"[${breaks:-$'\\n'}]\"\n"
    "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD}\"; do\n"
    "    if ((${#words[@]} > 0)) && [[ $word == $breaks* || ${words[-1]} == *$breaks ]]; then\n"
    "      words[-1]+=$word\n"
    "    else\n"
    "      words+=(\"$word\")\n"
    "    fi\n"
    "  done\n"
    "  part=${words[-1]##*$breaks}\n"
    "  kept=${words[-1]%\"$part\"}\n"
    "  COMPREPLY=()\n"
    "  mapfile -t lines < <(\"${1/#\\~/$HOME}\" completion words -- \"${words[@]}\" 2>/dev/null)\n"
    "  for line in \"${lines[@]}\"; do\n"
    "    case $line in\n"
    "      :file) mapfile -t files < <(compgen -f -- \"$part\") ;;\n"
    "      :folder) mapfile -t files < <(compgen -d -- \"$part\") ;;\n"
    "      *)\n"
    "        word=${line%%$'\\t'*}\n"
    "        COMPREPLY+=(\"${word#\"$kept\"}\")\n"
    "        [[ $word != *[:=] ]] || compopt -o nospace 2>/dev/null\n"
    "        ;;\n"
    "    esac\n"
    "  done\n"
    "  if ((${#files[@]} > 0)); then\n"
    "    COMPREPLY+=(\"${files[@]}\")\n"
    "    compopt -o filenames 2>/dev/null\n"
    "  fi\n"
    "}\n"
    "complete -F _aureole aureole\n";

static const char zsh_script[] =
    "#compdef aureole\n"
    "# Completion of aureole for zsh: source <(aureole completion zsh)\n"
    "_aureole() {\n"
    "  local -a lines closed closed_help open open_help\n"
    "  local line word files=\n"
    "  lines=(\"${(@f)$(\"${(Q)words[1]}\" completion words -- \"${(@Q)words[2,CURRENT]}\" 2>/dev/null)}\")\n"
    "  for line in $lines; do\n"
    "    word=${line%%$'\\t'*}\n"
    "    case $line in\n"
    "      (:file) files=_files ;;\n"
    "      (:folder) files='_files -/' ;;\n"
    "      (*[:=]$'\\t'*) open+=(\"$word\") open_help+=(\"$word  -- ${line#*$'\\t'}\") ;;\n"
    "      (*) closed+=(\"$word\") closed_help+=(\"$word  -- ${line#*$'\\t'}\") ;;\n"
    "    esac\n"
    "  done\n"
    "  (( $#closed )) && compadd -l -d closed_help -a closed\n"
    "  (( $#open )) && compadd -l -d open_help -S '' -a open\n"
    "  if [[ -n $files ]]; then\n"
    "    compset -P '--*='\n"
    "    ${=files}\n"
    "  fi\n"
    "}\n"
    "if [[ $funcstack[1] == _aureole ]]; then\n"
    "  _aureole \"$@\"\n"
    "else\n"
    "  compdef _aureole aureole\n"
    "fi\n";

static const char fish_script[] =
    "# Completion of aureole for fish: aureole completion fish | source\n"
    "function __aureole_complete\n"
    "    set -l words (commandline -opc) (commandline -ct)\n"
    "    set -l kept (string replace -r -- '^(--[^=]*=)?.*' '$1' $words[-1])\n"
    "    set -l part (string replace -r -- '^--[^=]*=' '' $words[-1])\n"
    "    for line in (command $words[1] completion words -- $words[2..-1] 2>/dev/null)\n"
    "        switch $line\n"
    "            case :file\n"
    "                string join \\n -- $kept(__fish_complete_path $part)\n"
    "            case :folder\n"
    "                string join \\n -- $kept(__fish_complete_directories $part)\n"
    "            case '*'\n"
    "                string join \\n -- $line\n"
    "        end\n"
    "    end\n"
    "end\n"
    "complete -c aureole -f -a '(__aureole_complete)'\n";

static const struct shell {
    const char *name, *script;
} shells[] = {{"bash", bash_script}, {"zsh", zsh_script}, {"fish", fish_script}};

enum { SHELL_COUNT = sizeof shells / sizeof shells[0] };

static const char *shell_name(unsigned index) {
    return index < SHELL_COUNT ? shells[index].name : NULL;
}

static int run(const cli_call *call) {
    const char *const shell = call->operands[0];
    if (strcmp(shell, "words") == 0) {
        cli_complete(call->commands, call->operand_count - 1, call->operands + 1);
        return CLI_SUCCESS;
    }
    for (size_t i = 0; i < SHELL_COUNT && call->operand_count == 1; ++i) {
        if (strcmp(shells[i].name, shell) == 0) {
            fputs(shells[i].script, stdout);
            return CLI_SUCCESS;
        }
    }
    return cli_bad_usage("completion: %s: try 'aureole help completion'", call->command->too_few);
}

const cli_command cli_command_completion = {
    .name = "completion",
    .summary = "print a script for shell completion of commands, options, names and parameters",
    .notes = "The scripts call 'aureole completion words -- WORD...' for the completions of the last word: "
             "one per line, with a tab and its help. In bash: source <(aureole completion bash); in zsh: "
             "source <(aureole completion zsh), after compinit; in fish: aureole completion fish | source. "
             "Installation puts the scripts where the shells find them.",
    .too_few = "expected bash, zsh or fish",
    .operands = {{"SHELL", "bash, zsh or fish", .name = shell_name},
                 {"WORD", "used by the scripts", .optional = true, .repeated = true}},
    .run = run,
};

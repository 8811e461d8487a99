# Completion of `stillpoint` in bash. It asks the program itself for commands, options, names and keys.

# Words of the first column of a list: '  leapfrog   1 …'
_stillpoint_names() {
  local topic
  for topic; do stillpoint list "$topic" 2>/dev/null | sed -nE 's/^  ([a-z][a-z0-9:+-]*) .*/\1/p'; done
}

# Keys with their table, as --set wants them: 'grid.cells='
_stillpoint_keys() {
  stillpoint list keys 2>/dev/null | awk '
    /^  \[/ { table = $1; gsub(/[]:[]/, "", table); table = table "."; if ($1 ~ /^\[\[/) sub(/\.$/, "[0].", table) }
    /^  top of/ { table = "" }
    /^    [a-z]/ && table !~ /</ { print table $1 "=" }' | sort -u
}

_stillpoint() {
  local word=$2 before=$3 command=${COMP_WORDS[1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$(stillpoint --help | sed -n '/^Subcommands/,$ s/^  \([a-z]*\) .*/\1/p') --help --version" -- "$word")
    return
  fi
  case $before in
    --set | --vary)
      mapfile -t COMPREPLY < <(compgen -W "$(_stillpoint_keys)" -- "$word")
      compopt -o nospace
      return
      ;;
    --out | --resume)
      if [[ $before == --out && $command == plot ]]; then
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
        compopt -o filenames
        return
      elif [[ $before == --out || $command == run ]]; then
        mapfile -t COMPREPLY < <(compgen -d -- "$word")
        compopt -o filenames
        return
      fi
      ;;
    --strategies) mapfile -t COMPREPLY < <(compgen -W "$(_stillpoint_names dampings relaxations solvers)" -- "$word"); return ;;
    --integrators) mapfile -t COMPREPLY < <(compgen -W "$(_stillpoint_names integrators)" -- "$word"); return ;;
    --refine) mapfile -t COMPREPLY < <(compgen -W "h points step rtol motion" -- "$word"); return ;;
    --format) mapfile -t COMPREPLY < <(compgen -W "text markdown schema" -- "$word"); return ;;
    --field) mapfile -t COMPREPLY < <(compgen -W "plastic_strain u u_x u_y u_z v stress_xx stress_yy stress_zz stress_xy layers" -- "$word"); return ;;
    --cut)
      mapfile -t COMPREPLY < <(compgen -W "x= y= z=" -- "$word")
      compopt -o nospace
      return
      ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(stillpoint "$command" --help 2>/dev/null | grep -oE -- '^ +(-h,)?--[a-z-]+' | grep -oE -- '--[a-z-]+')" -- "$word")
  elif [[ $command == list ]]; then
    mapfile -t COMPREPLY < <(compgen -W "integrators dampings relaxations solvers materials solutions bases keys" -- "$word")
  elif [[ $command == plot && $COMP_CWORD == 2 ]]; then
    mapfile -t COMPREPLY < <(compgen -W "history fields compare converge" -- "$word")
  elif [[ $command == plot ]]; then
    mapfile -t COMPREPLY < <(compgen -d -- "$word")
    compopt -o filenames
  else
    mapfile -t COMPREPLY < <(compgen -f -X '!*.toml' -- "$word"; compgen -d -- "$word")
    compopt -o filenames
  fi
}
complete -F _stillpoint stillpoint

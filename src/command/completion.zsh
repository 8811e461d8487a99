#compdef stillpoint
# Completion of `stillpoint` in zsh. It asks the program itself for commands, options, names and keys.

# Words of the first column of a list: '  leapfrog   1 …'
_stillpoint_names() {
  local topic
  for topic; do stillpoint list $topic 2>/dev/null | sed -nE 's/^  ([a-z][a-z0-9:+-]*) .*/\1/p'; done
}

# Keys with their table, as --set wants them: 'grid.cells='
_stillpoint_keys() {
  stillpoint list keys 2>/dev/null | awk '
    /^  \[/ { table = $1; gsub(/[]:[]/, "", table); table = table "."; if ($1 ~ /^\[\[/) sub(/\.$/, "[0].", table) }
    /^  top of/ { table = "" }
    /^    [a-z]/ && table !~ /</ { print table $1 "=" }' | sort -u
}

# What may stand behind an option; fails if that is no option with a value that is known here.
_stillpoint_value() {
  local command=$1 option=$2
  case $option in
    --set | --vary) compadd -S '' -- ${(f)"$(_stillpoint_keys)"} ;;
    --out)
      if [[ $command == plot ]]; then _files; else _files -/; fi
      ;;
    --resume)
      [[ $command == run ]] || return 1
      _files -/
      ;;
    --strategies) compadd -- ${(f)"$(_stillpoint_names dampings relaxations solvers)"} ;;
    --integrators) compadd -- ${(f)"$(_stillpoint_names integrators)"} ;;
    --refine) compadd -- h points step rtol motion ;;
    --format) compadd -- text markdown schema ;;
    --field) compadd -- plastic_strain u u_x u_y u_z v stress_xx stress_yy stress_zz stress_xy layers ;;
    --cut) compadd -S '' -- x= y= z= ;;
    *) return 1 ;;
  esac
}

_stillpoint() {
  local command=$words[2] word=$words[CURRENT]
  if ((CURRENT == 2)); then
    compadd -- ${(f)"$(stillpoint --help 2>/dev/null | sed -n '/^Subcommands/,$ s/^  \([a-z]*\) .*/\1/p')"} --help --version
  elif _stillpoint_value "$command" "$words[CURRENT-1]"; then
    return
  elif [[ $word == -* ]]; then
    compadd -- ${(f)"$(stillpoint "$command" --help 2>/dev/null | grep -oE -- '^ +(-h,)?--[a-z-]+' | grep -oE -- '--[a-z-]+')"}
  elif [[ $command == list ]]; then
    compadd -- integrators dampings relaxations solvers materials solutions bases keys
  elif [[ $command == plot ]]; then
    if ((CURRENT == 3)); then compadd -- history fields compare converge; else _files -/; fi
  else
    _files -g '*.toml(-.)'
  fi
}

if [[ $funcstack[1] == _stillpoint ]]; then _stillpoint "$@"; else compdef _stillpoint stillpoint; fi

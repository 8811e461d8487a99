# Completion of `stillpoint` in fish. It asks the program itself for commands, options, names and keys.

# Words of the first column of a list: '  leapfrog   1 …'
function __stillpoint_names
    for topic in $argv
        stillpoint list $topic 2>/dev/null | string replace --regex --filter '^  ([a-z][a-z0-9:+-]*) .*' '$1'
    end
end

# Keys with their table, as --set wants them: 'grid.cells='
function __stillpoint_keys
    stillpoint list keys 2>/dev/null | awk '
        /^  \[/ { table = $1; gsub(/[]:[]/, "", table); table = table "."; if ($1 ~ /^\[\[/) sub(/\.$/, "[0].", table) }
        /^  top of/ { table = "" }
        /^    [a-z]/ && table !~ /</ { print table $1 "=" }' | sort -u
end

# Commands with what they do, as fish shows it beside them.
function __stillpoint_commands
    stillpoint --help 2>/dev/null | sed -n '/^Subcommands/,$ s/^  \([a-z]*\)  *\(.*\)/\1\t\2/p'
end

# The options of the command that is being written.
function __stillpoint_options
    set --local command (commandline --tokenize --cut-at-cursor)[2]
    stillpoint $command --help 2>/dev/null | grep -oE -- '^ +(-h,)?--[a-z-]+' | grep -oE -- '--[a-z-]+'
end

function __stillpoint_is
    set --local command (commandline --tokenize --cut-at-cursor)[2]
    contains -- "$command" $argv
end

# Whether the word before the cursor is one of these options.
function __stillpoint_after
    contains -- (commandline --tokenize --cut-at-cursor)[-1] $argv
end

function __stillpoint_after_no_value
    not __stillpoint_after --set --vary --out --resume --strategies --integrators --refine --format --field --cut
end

# fish puts the files of this kind first, and all others behind them.
function __stillpoint_scenes
    __fish_complete_suffix .toml | string match --regex '^[^\t]*(?:\.toml|/)(?:\t.*)?$'
end

function __stillpoint_words
    count (commandline --tokenize --cut-at-cursor)
end

set --local first 'test (__stillpoint_words) = 1'
set --local later 'test (__stillpoint_words) -gt 1; and __stillpoint_after_no_value'
complete --command stillpoint --no-files
complete --command stillpoint --condition $first --arguments '(__stillpoint_commands) --help --version'
complete --command stillpoint --condition "$later; and string match --quiet -- '-*' (commandline --current-token)" --arguments '(__stillpoint_options)'
complete --command stillpoint --condition '__stillpoint_after --set --vary' --arguments '(__stillpoint_keys)'
complete --command stillpoint --condition '__stillpoint_after --out --resume; and not __stillpoint_is plot converge' --arguments '(__fish_complete_directories)'
complete --command stillpoint --condition '__stillpoint_after --out; and __stillpoint_is converge' --arguments '(__fish_complete_directories)'
complete --command stillpoint --condition '__stillpoint_after --out; and __stillpoint_is plot' --force-files
complete --command stillpoint --condition '__stillpoint_after --strategies' --arguments '(__stillpoint_names dampings relaxations solvers)'
complete --command stillpoint --condition '__stillpoint_after --integrators' --arguments '(__stillpoint_names integrators)'
complete --command stillpoint --condition '__stillpoint_after --refine' --arguments 'h points step rtol motion'
complete --command stillpoint --condition '__stillpoint_after --format' --arguments 'text markdown schema'
complete --command stillpoint --condition '__stillpoint_after --field' --arguments 'plastic_strain u u_x u_y u_z v stress_xx stress_yy stress_zz stress_xy layers'
complete --command stillpoint --condition '__stillpoint_after --cut' --arguments 'x= y= z='
complete --command stillpoint --condition "$later; and __stillpoint_is list" --arguments 'integrators dampings relaxations solvers materials solutions bases keys'
complete --command stillpoint --condition "__stillpoint_is plot; and test (__stillpoint_words) = 2" --arguments 'history fields compare converge'
complete --command stillpoint --condition "__stillpoint_is plot; and test (__stillpoint_words) -gt 2; and __stillpoint_after_no_value" --arguments '(__fish_complete_directories)'
complete --command stillpoint --condition "$later; and __stillpoint_is run compare converge safety check spectrum" --arguments '(__stillpoint_scenes)'

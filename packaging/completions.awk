# Makes a shell's completion for a tool from what the tool prints for --help, which comes from its tables of options and methods: so
# new options and methods are completed as they come.
# Usage: TOOL --help | awk -v tool=TOOL -v shell=bash|zsh|fish -f completions.awk

# An option: "  -j,--threads N    most threads". Two spaces or more end the names and the value's name.
/^  -/ {
    line = substr($0, 3)
    split_at = match(line, /  +/)
    left = split_at ? substr(line, 1, split_at - 1) : line
    help[++count] = split_at ? substr(line, RSTART + RLENGTH) : ""
    names[count] = left
    sub(/ .*/, "", names[count])
    value[count] = left
    if (!sub(/^[^ ]* /, "", value[count])) value[count] = ""
    help_column = split_at ? 2 + split_at + RLENGTH - 1 : 0
    next
}

# One of an option's choices: two columns to the right of its help.
count && /^   / {
    match($0, /^ +/)
    if (help_column == 0) help_column = RLENGTH
    if (RLENGTH == help_column + 2) choices[count] = choices[count] (choices[count] == "" ? "" : " ") $1
    else if (RLENGTH == help_column && choices[count] == "" && help[count] !~ /[:;(]/) help[count] = help[count] " " substr($0, RLENGTH + 1)
    next
}

/^Usage:/ { takes_file = /\[[A-Z]/ }
/^$/ { help_column = -9 }

function is_file(i) { return value[i] ~ /FILE|bvhx|hits|DIRECTORY/ }

# The first clause of an option's help: shells show one line.
function brief(i,    text) {
    text = help[i]
    sub(/ \(default.*/, "", text)
    sub(/[:;] .*/, "", text)
    sub(/:$/, "", text)
    gsub(/'/, "", text)
    gsub(/[][]/, "", text)
    return text
}

function bash(    i, all, pattern, identifier) {
    identifier = tool
    gsub(/-/, "_", identifier)
    print "# bash completion for " tool
    print "_" identifier "() {"
    print "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}"
    print "    [ \"$word\" != = ] || word="
    print "    [ \"$before\" != = ] || before=${COMP_WORDS[COMP_CWORD-2]}"
    print "    case $before in"
    for (i = 1; i <= count; ++i) {
        all = all (i > 1 ? " " : "") names[i]
        if (value[i] == "") continue
        pattern = names[i]
        gsub(/,/, "|", pattern)
        printf "        %s) ", pattern
        if (choices[i] != "")
            printf "mapfile -t COMPREPLY < <(compgen %s-W '%s' -- \"$word\") ;;\n", is_file(i) ? "-f " : "", choices[i]
        else if (is_file(i))
            print "compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- \"$word\") ;;"
        else
            print "COMPREPLY=() ;;"
    }
    gsub(/,/, " ", all)
    print "        *)"
    print "            case $word in"
    print "                -*) mapfile -t COMPREPLY < <(compgen -W '" all "' -- \"$word\") ;;"
    print "                *) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- \"$word\") ;;"
    print "            esac ;;"
    print "    esac"
    print "}"
    print "complete -F _" identifier " " tool
}

function zsh(    i, n, parts, spec) {
    print "#compdef " tool
    printf "_arguments -s -S"
    for (i = 1; i <= count; ++i) {
        spec = "[" brief(i) "]"
        if (value[i] != "") {
            spec = spec ":value:"
            if (choices[i] != "" && is_file(i)) spec = spec "{compadd " choices[i] "; _files}"
            else if (choices[i] != "") spec = spec "(" choices[i] ")"
            else if (is_file(i)) spec = spec "_files"
        }
        n = split(names[i], parts, ",")
        if (n == 1) printf " \\\n    '%s%s'", parts[1], spec
        else printf " \\\n    '(%s %s)'{%s,%s}'%s'", parts[1], parts[2], parts[1], parts[2], spec
    }
    print " \\\n    '*:file:_files'"
}

function fish(    i, k, n, parts) {
    for (i = 1; i <= count; ++i) {
        printf "complete -c %s", tool
        n = split(names[i], parts, ",")
        for (k = 1; k <= n; ++k)
            printf " %s", parts[k] ~ /^--/ ? "-l " substr(parts[k], 3) : "-s " substr(parts[k], 2)
        if (choices[i] != "") printf " %s -a '%s'", is_file(i) ? "-r -F" : "-x", choices[i]
        else if (is_file(i)) printf " -r -F"
        else if (value[i] != "") printf " -x"
        printf " -d '%s'\n", brief(i)
    }
}

END {
    if (count == 0) {
        print "completions.awk: no options in the help of " tool > "/dev/stderr"
        exit 1
    }
    if (shell == "bash") bash()
    else if (shell == "zsh") zsh()
    else fish()
}

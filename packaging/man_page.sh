#!/bin/sh
# Makes a manual page of section 1 from a tool's page in Markdown, on standard output: its first sentence becomes the line under NAME,
# as man wants it. Usage: man_page.sh PAGE.md VERSION
set -eu
tool=$(basename "$1" .md)
awk -v tool="$tool" '
    NR == 1 { next }  # the title
    !named && /^[^ ]/ {
        summary = summary (summary == "" ? "" : " ") $0
        if (summary !~ /\.( |$)/) next
        rest = summary
        sub(/\.( .*|$)/, "", summary)
        rest = substr(rest, length(summary) + 2)
        gsub(/`/, "", summary)  # programs that list manual pages read this line
        print "# NAME\n\n" tool " - " tolower(substr(summary, 1, 1)) substr(summary, 2) "\n"
        if (rest != "") lead = substr(rest, 2)
        named = 1
        next
    }
    /^## / {
        print "# " toupper(substr($0, 4))
        if (lead != "" && /^## Description/) print "\n" lead
        if (/^## Description/) lead = ""
        next
    }
    /^###/ { print substr($0, 2); next }
    { print }' "$1" |
    lowdown -s -tman --parse-no-super -M title="$tool" -M section=1 -M source="bvhio $2" -M volume="bvhio manual"

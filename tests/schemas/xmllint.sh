#!/bin/sh
# Validates the profiles and the samples with libxml2, independently of the server: profiles and samples in valid/ must be valid,
# samples in invalid/ must be invalid. Also checks that invalid/manifest.tsv (file, line of the offending start tag, error;
# tab-separated) lists each invalid sample once, and that a start tag begins on its line. Every XML example in a document (*.md) must
# be well-formed, with all prefixes declared: one document, or one per line. Exits with 1 after any error.
set -u

schemas=$(cd "$(dirname "$0")/../../schemas" && pwd) || exit 1
cd "$schemas" || exit 1
if ! command -v xmllint >/dev/null; then
    echo "xmllint is missing (Debian: libxml2-utils)"
    exit 1
fi

verdicts=$(mktemp) || exit 1
examples=$(mktemp -d) || exit 1
trap 'rm -rf "$verdicts" "$examples"' EXIT
checked=0
failed=0

complain() {
    echo "NOT OK  $1"
    failed=$((failed + 1))
}

# judge SCHEMA VERDICT FILE...: xmllint must print "FILE VERDICT" for each file. Otherwise shows its output.
judge() {
    schema=$1
    verdict=$2
    shift 2
    xmllint --nonet --noout --schema "$schema" "$@" 2>"$verdicts"
    for file in "$@"; do
        checked=$((checked + 1))
        if ! grep -qxF "$file $verdict" "$verdicts"; then
            complain "$file: expected: $verdict with $schema"
            grep -F "$file" "$verdicts"
        fi
    done
}

judge rois.xsd validates profiles/*.xml ../components/simulation/profiles/*.xml ../components/simulation/data/simulated_hall.xml
judge hall.xsd validates ../components/simulation/data/reception-*.xml ../components/simulation/data/two-robots.xml
judge scenario.xsd validates ../client-cpp/scenarios/*.xml
judge map.xsd validates samples/floor_map.xml
judge messages.xsd validates profiles/*.xml samples/valid/*.xml
judge messages.xsd "fails to validate" samples/invalid/*.xml

tab=$(printf '\t')
while IFS="$tab" read -r file line what; do
    checked=$((checked + 1))
    if [ -z "$what" ]; then
        complain "manifest.tsv: $file: expected three columns"
    elif ! sed -n "${line}p" "samples/invalid/$file" | grep -q '<[A-Za-z]'; then
        complain "manifest.tsv: $file: no start tag in line $line"
    fi
done <samples/invalid/manifest.tsv
for file in samples/invalid/*.xml; do
    listed=$(cut -f 1 samples/invalid/manifest.tsv | grep -cxF "$(basename "$file")")
    [ "$listed" -eq 1 ] || complain "manifest.tsv: $(basename "$file") is listed $listed times"
done

# Prints the errors in standard input; nothing if it is well-formed. The exit status of xmllint ignores undeclared prefixes.
faults() { xmllint --nonet --noout - 2>&1; }

# Writes each example to a file named by its line.
examples_of() {
    awk -v to="$examples/" '/^```/ { example = example == "" ? substr($0, 4) : ""; file = to (FNR + 1); next }
        example == "xml" { print > file }' "$1"
}

for document in ../README.md ../docs/*.md ../web/*/README.md; do
    examples_of "$document"
    for example in "$examples"/*; do
        [ -e "$example" ] || continue
        checked=$((checked + 1))
        where="$document, example in line $(basename "$example")"
        wrong=$(faults <"$example")
        [ -n "$wrong" ] || continue
        while IFS= read -r line; do
            printf '%s\n' "$line" | faults >"$verdicts"
            [ ! -s "$verdicts" ] || { complain "$where: $wrong"; break; }
        done <"$example"
    done
    rm -f "$examples"/*
done

echo "$checked checked, $failed failed"
[ "$failed" -eq 0 ]

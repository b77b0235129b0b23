# expect.sh: sourced by the tests that are scripts. Gives them a scratch folder and two words.

tools=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../tools" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# expect_pass COMMAND...
expect_pass() {
    "$@" >"$scratch/.output" 2>&1 && return
    echo "must pass, but failed: $*"
    cat "$scratch/.output"
    exit 1
}

# expect_fail TEXT COMMAND...: the command must fail and print the text.
expect_fail() {
    local text=$1
    shift
    if "$@" >"$scratch/.output" 2>&1; then
        echo "must fail, but passed: $*"
    elif grep -qF -- "$text" "$scratch/.output"; then
        return
    else
        echo "must say \"$text\": $*"
    fi
    cat "$scratch/.output"
    exit 1
}

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The number of the version is written in several places, and they agree: both CMake projects, the changelog (with the date of the release), the
# packages' changelog, the manual pages, the comment of nc_version().
set -euo pipefail
cd "$NC_SOURCE_DIR"
version=$(sed -n 's/^project(libnc VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || { echo "no version in CMakeLists.txt"; exit 1; }
exact=${version//./\\.}
status=0
says() {  # says FILE REGEX: the file has a line of this form
  grep -qE "$2" "$1" || { echo "$1 does not say version $version (no line like $2)"; status=1; }
}
says libnc/CMakeLists.txt "^project\\(libnc VERSION $exact "
says CHANGELOG.md "^## $exact - [0-9]{4}-[0-9]{2}-[0-9]{2}\$"
says packaging/debian/changelog "^libnc \\($exact-[0-9]+\\)"
says libnc/include/nc/control.h "@return \"$exact\", constant"
for page in packaging/man/*.[1-8]; do says "$page" "^\\.TH .* \"libnc $exact\""; done
# The coming version stands above the others, which descend from top to bottom.
headings=$(sed -n 's/^## //p' CHANGELOG.md)
[ "$(head -n 1 <<<"$headings")" = Unreleased ] || { echo "the first heading of CHANGELOG.md is not Unreleased"; status=1; }
numbers=$(tail -n +2 <<<"$headings" | cut -d' ' -f1)
[ "$numbers" = "$(sort -rV <<<"$numbers")" ] || { echo "the versions in CHANGELOG.md do not fall"; status=1; }
exit $status

# SPDX-License-Identifier: Apache-2.0
# Number of the binary interface: the SONAME is libnc.so.<NC_ABI>, the symbols' version NC_<NC_ABI>, the Debian package libnc<NC_ABI>. It moves
# by one with every version whose interface breaks programs that were linked before (CONTRIBUTING.md, "The binary interface"), and only then.
set(NC_ABI 1)

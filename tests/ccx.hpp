// Whether CalculiX is there to compare with.
#pragma once
#include <doctest/doctest.h>

#include <cstdlib>

namespace aquagraph::test {

inline bool ccx_is_missing() {
    if (std::system("command -v ccx > /dev/null 2>&1") == 0) return false;
    MESSAGE("skipped: ccx is not installed (Debian package calculix-ccx)");
    return true;
}

}  // namespace aquagraph::test

// How often memory was asked for: operator new of the whole program, and CHOLMOD's malloc while a CountCholmodToo
// lives.
#pragma once

namespace aquagraph::solid::test {

long allocations();

struct CountCholmodToo {
    CountCholmodToo();
    ~CountCholmodToo();
    CountCholmodToo(const CountCholmodToo&) = delete;
    CountCholmodToo& operator=(const CountCholmodToo&) = delete;
};

}  // namespace aquagraph::solid::test

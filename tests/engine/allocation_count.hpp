// How often the program asked for memory through operator new, aligned or not. CHOLMOD's and oneTBB's own are not
// among them.
#pragma once

namespace aquagraph::test {

long allocations();

}  // namespace aquagraph::test

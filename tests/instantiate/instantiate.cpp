// SPDX-License-Identifier: BSD-3-Clause
// Every class template instantiated whole, for every scalar it is meant for: a member that nobody calls yet must
// compile too.

#include "tetrapore/core.hpp"
#include "tetrapore/law/entry/concept.hpp"
#include "tetrapore/simplex/edge.hpp"
#include "tetrapore/simplex/opening.hpp"
#include "tetrapore/simplex/pore_body.hpp"
#include "tetrapore/simplex/throat.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

template class required<double>;
template struct id<grain_tag>;
template struct id<pore_tag>;
template struct outcome<double, entry_status>;

#define TETRAPORE_INSTANTIATE(T) \
  template struct vec3<T>;       \
  template struct vec2<T>;       \
  template struct edge<T>;       \
  template struct throat<T>;     \
  template struct opening<T>;    \
  template struct pore_body<T>

TETRAPORE_INSTANTIATE(float);
TETRAPORE_INSTANTIATE(double);
TETRAPORE_INSTANTIATE(long double);

}  // namespace tetrapore::inline TETRAPORE_ABI

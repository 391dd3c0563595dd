// SPDX-License-Identifier: BSD-3-Clause
// A family of reasons says which verdict each stands for.
#include "tetrapore/core/outcome.hpp"

namespace mine {
enum class why { fine };
constexpr tetrapore::verdict verdict_of(why) { return tetrapore::verdict::ok; }
constexpr const char* describe(why) { return "fine"; }
}  // namespace mine

tetrapore::outcome<double, mine::why> answer{1.0, mine::why::fine};

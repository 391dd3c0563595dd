// SPDX-License-Identifier: BSD-3-Clause
// A family of reasons says which verdict each stands for.
// expect: verdict_of\(s\). (is invalid|would be invalid)
#include "tetrapore/core/outcome.hpp"

namespace mine {
enum class why { fine };
constexpr tetrapore::verdict verdict_for(why) { return tetrapore::verdict::ok; }
constexpr const char* describe(why) { return "fine"; }
}  // namespace mine

tetrapore::outcome<double, mine::why> answer{1.0, mine::why::fine};

// SPDX-License-Identifier: BSD-3-Clause
// The closed forms of a bridge with every rupture rule and scalar, and tables of several sizes, instantiated whole.

#include "tetrapore/law/bridge.hpp"
#include "tetrapore/law/bridge/closed_forms.hpp"
#include "tetrapore/law/bridge/table.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

#define TETRAPORE_FORMS(rule)              \
  template struct willett<rule>;           \
  template struct willett_small<rule>;     \
  template struct lambert<rule>;           \
  template struct rabinovich<rule>;        \
  template struct soulie<rule>;            \
  template struct mikami<rule>;            \
  template struct weigert_ripperger<rule>; \
  template struct toroid<rule>;
TETRAPORE_FORMS(lian_rupture)
TETRAPORE_FORMS(willett_rupture)
TETRAPORE_FORMS(mikami_rupture)
TETRAPORE_FORMS(without_rupture)
#undef TETRAPORE_FORMS

template struct toroid_ring<float>;
template struct toroid_ring<long double>;
template class bridge_table<1, 2>;
template class bridge_table<16, 12>;
template table_report bridge_table<1, 2>::build(const young_laplace<>&, const table_range&) noexcept;
template struct tabulated<bridge_table<1, 2>>;

template <class T>
constexpr bool every_form =
    bridge_law<willett<>, T> && bridge_law<willett_small<>, T> && bridge_law<lambert<>, T> &&
    bridge_law<rabinovich<>, T> && bridge_law<soulie<>, T> && bridge_law<mikami<>, T> &&
    bridge_law<weigert_ripperger<>, T> && bridge_law<toroid<>, T> && bridge_law<toroid<>, T, given_suction<T>> &&
    bridge_law<held_at_contact<willett<>>, T> && bridge_law<tabulated<>, T> && rupture_rule<lian_rupture, T> &&
    rupture_rule<willett_rupture, T> && rupture_rule<mikami_rupture, T> && rupture_rule<without_rupture, T>;
static_assert(every_form<float> && every_form<double> && every_form<long double>);
static_assert(!bridge_law<willett<>, double, given_suction<double>>, "a fit to a volume knows no suction");
static_assert(tabulable<young_laplace<>> && !tabulable<willett<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI

// SPDX-License-Identifier: BSD-3-Clause
// The laws of a film and of a contact for every scalar, one over the other, instantiated whole.

#include "tetrapore/law/bridge/liquid.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"
#include "tetrapore/law/contact.hpp"
#include "tetrapore/law/lubrication.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

template struct rough<leading_order>;
template struct rough<two_spheres>;
template struct rough<sphere_plane>;
template struct rough<rough<two_spheres>>;
template struct wet_contact<leading_order>;
template struct wet_contact<two_spheres>;
template struct wet_contact<rough<sphere_plane>>;

#define TETRAPORE_FILM(T, Film)                                                                      \
  template outcome<pair_resistance<T>, pair_status> Film::resistance(const edge<T>&) const noexcept; \
  template outcome<pair_resistance<T>, pair_status> rough<Film>::resistance(const edge<T>&) const noexcept

#define TETRAPORE_CONTACT(T, Law)                                                                                \
  template struct Law::state<T>;                                                                                 \
  template Law::state<T> Law::start(const edge<T>&) const noexcept;                                              \
  template outcome<contact_forces<T>, contact_status> Law::step(const edge<T>&, const pair_motion<T>&, const T&, \
                                                                Law::state<T>&) const noexcept

#define TETRAPORE_WET(T, Film)             \
  TETRAPORE_CONTACT(T, wet_contact<Film>); \
  template wet_contact<Film>::state<T> wet_contact<Film>::start(const edge<T>&, const T&) const noexcept

#define TETRAPORE_PAIR_LAWS(T)                                                                                         \
  template struct pair_resistance<T>;                                                                                  \
  template struct pair_motion<T>;                                                                                      \
  template struct pair_forces<T>;                                                                                      \
  template struct relative_motion<T>;                                                                                  \
  template struct contact_forces<T>;                                                                                   \
  template struct elastic_film<T>;                                                                                     \
  template struct approach<T>;                                                                                         \
  template struct bridge_presence<T>;                                                                                  \
  template bool share_liquid(const T&, T*, const T*, std::size_t) noexcept;                                            \
  template relative_motion<T> relative_motion_of(const pair_motion<T>&, const vec3<T>&, T, T) noexcept;                \
  template pair_forces<T> apply(const pair_resistance<T>&, const pair_motion<T>&) noexcept;                            \
  template T power(const pair_resistance<T>&, const pair_motion<T>&) noexcept;                                         \
  template T leading_order::logarithm(const T&, const T&) noexcept;                                                    \
  template outcome<T, film_status> step_film(const elastic_film<T>&, const T&, const T&, const T&, const T&,           \
                                             const film_scheme&) noexcept;                                             \
  template outcome<approach<T>, film_status> step_approach(const approach<T>&, const T&, const T&, const T&, const T&, \
                                                           film_variable) noexcept;                                    \
  TETRAPORE_FILM(T, leading_order);                                                                                    \
  TETRAPORE_FILM(T, two_spheres);                                                                                      \
  TETRAPORE_FILM(T, sphere_plane);                                                                                     \
  TETRAPORE_CONTACT(T, dry_contact);                                                                                   \
  TETRAPORE_WET(T, leading_order);                                                                                     \
  TETRAPORE_WET(T, two_spheres);                                                                                       \
  TETRAPORE_WET(T, rough<sphere_plane>);

TETRAPORE_PAIR_LAWS(float)
TETRAPORE_PAIR_LAWS(double)
TETRAPORE_PAIR_LAWS(long double)

#undef TETRAPORE_PAIR_LAWS
#undef TETRAPORE_WET
#undef TETRAPORE_CONTACT
#undef TETRAPORE_FILM

template <class T>
constexpr bool every_film =
    lubrication_law<leading_order, T> && lubrication_law<two_spheres, T> && lubrication_law<sphere_plane, T> &&
    lubrication_law<rough<leading_order>, T> && lubrication_law<rough<rough<two_spheres>>, T>;
static_assert(every_film<float> && every_film<double> && every_film<long double>);

template <class T>
constexpr bool every_contact =
    contact_law<dry_contact, T> && contact_law<wet_contact<>, T> && contact_law<wet_contact<two_spheres>, T> &&
    contact_law<wet_contact<rough<sphere_plane>>, T>;
static_assert(every_contact<float> && every_contact<double> && every_contact<long double>);

static_assert(!lubrication_law<dry_contact> && !lubrication_law<rough<dry_contact>>, "a contact is no film");
static_assert(!contact_law<two_spheres> && !contact_law<wet_contact<dry_contact>>, "a film alone is no contact");

}  // namespace tetrapore::inline TETRAPORE_ABI

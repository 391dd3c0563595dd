#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# wet_collision_test.sh FOLDER: runs the program FOLDER/wet_collision with every option and bad input, and checks the
# keys on stdout, the files, the messages and the exit codes, and what is known exactly of two grains that collide.
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/common.sh"

refused="refused_flooded refused_not_covered refused_invalid_input refused_not_converged"
pair="stokes restitution restitution_theory stuck duration largest_overlap largest_force thinnest_film formed ruptures \
bridges rupture_gap energy_before energy_kinetic energy_elastic energy_capillary dissipated_film dissipated_friction \
dissipated_rupture energy_defect momentum_defect angular_momentum_defect liquid_defect steps $refused"
sweep="critical_stokes_film critical_stokes_wet critical_stokes_film_theory critical_stokes_wet_theory sweep_defect"
cloud="cloud_grains cloud_energy_before cloud_energy_kinetic cloud_energy_potential cloud_energy_elastic \
cloud_energy_capillary cloud_dissipated_film cloud_dissipated_friction cloud_dissipated_rupture cloud_energy_defect \
cloud_formed cloud_ruptures cloud_bridges cloud_liquid cloud_liquid_in_bridges cloud_liquid_defect cloud_thinnest_film \
cloud_largest_overlap cloud_steps $(printf 'cloud_%s ' $refused)"
seconds="seconds_pair seconds_sweep seconds_cloud"

within() { holds "$(value "$1")" "> -($2)" && holds "$(value "$1")" "< $2" || fail "$title: $1=$(value "$1"), expected within $2"; }
# near A B E: A and B, which awk computes, are less than E apart.
near() { awk "BEGIN { d = ($1) - ($2); exit !(d > -($3) && d < $3) }" </dev/null || fail "$title: $1, expected $2 to $3"; }

every_run() {
  local key
  expect thinnest_film "> 0"
  within momentum_defect 1e-12
  within angular_momentum_defect 1e-12
  within energy_defect 0.01
  for key in $refused; do expect "$key" "== 0"; done
  within liquid_defect 1e-12
  expect dissipated_film ">= 0"
  expect dissipated_friction ">= -1e-12 * $(value energy_before)"
  [ "$(value formed)" = "$(($(value ruptures) + $(value bridges)))" ] || fail "$title: bridges formed and gone"
  if [[ " $keys " = *" cloud_steps "* ]]; then
    within cloud_liquid_defect 1e-12
    within cloud_energy_defect 0.02
    expect cloud_thinnest_film "> 0"
    expect cloud_dissipated_film ">= 0"
    expect cloud_dissipated_friction ">= 0"
    [ "$(value cloud_formed)" = "$(($(value cloud_ruptures) + $(value cloud_bridges)))" ] ||
      fail "$title: bridges of the cloud formed and gone"
    for key in $refused; do expect "cloud_$key" "== 0"; done
  fi
}

keys="$pair $sweep $cloud $seconds"
files="cloud.csv cloud.svg collision.csv restitution.csv restitution.svg"
small="--points 4 --sweep-to 40 --grains 40 --time 0.01"
runs "everything, small" $small --steps-per-contact 250
expect cloud_ruptures "> 0"
expect cloud_bridges "> 0"
[ "$(wc -l <out/restitution.csv)" = 9 ] || fail "restitution.csv: expected four Stokes numbers and the critical ones"
near "$(value critical_stokes_film)" "$(value critical_stokes_film_theory)" "0.05 * $(value critical_stokes_film)"
expect critical_stokes_wet "> 1.5 * $(value critical_stokes_film)"
sed '/^seconds/d' stdout >first
runs "again" $small --steps-per-contact 250
sed '/^seconds/d' stdout | cmp -s first - || fail "a second run gives other numbers"
runs "another seed" $small --steps-per-contact 250 --seed 2
sed '/^seconds/d' stdout | cmp -s first - && fail "another seed gives the same numbers"

# Grains of two sizes, no gravity, the accurate film, friction.
runs "two sizes" $small --steps-per-contact 250 --radius2 0.7e-3 --gravity 0 --film-law accurate --obliquity 30
expect dissipated_friction "> 0"

keys="$pair $seconds"
files="collision.csv"
alone="--points 0 --grains 0"

# Nothing takes energy: the same speed back, to more than the second order in the step, and half a period of contact.
dry="$alone --viscosity 0 --volume 0"
runs "dry, coarse" $dry --steps-per-contact 50
within "energy_defect" 1e-4
coarse=$(awk -v x="$(value restitution)" 'BEGIN { print x < 1 ? 1 - x : x - 1 }')
runs "dry, fine" $dry --steps-per-contact 200
fine=$(awk -v x="$(value restitution)" 'BEGIN { print x < 1 ? 1 - x : x - 1 }')
holds "$fine" "< $coarse / 16" || fail "$title: restitution off by $fine, $coarse with steps four times as long"
near "$(value restitution)" 1 1e-6
# π √(m/k) and v √(m/k), m = 5.235987756e-6 kg
near "$(value duration)" 7.18871e-5 4e-7  # the step
near "$(value largest_overlap)" 4.576457e-6 1e-9
runs "dry, oblique, rough" $dry --obliquity 45
expect dissipated_friction "> 0"
near "$(value restitution)" 1 5e-3  # but for the angle by which the line of centres turns meanwhile
runs "dry, unequal" $dry --radius2 0.4e-3
near "$(value restitution)" 1 1e-6

# A mirror: the momentum of the pair stays zero.
runs "mirror" $alone
[ "$(value momentum_defect)" = 0 ] || fail "$title: momentum_defect=$(value momentum_defect)"
expect ruptures "== 1"
restitution=$(value restitution)

# The film alone, between hard grains: 1 - 2 ln(film/roughness)/St.
film="$alone --volume 0 --viscosity 1e-3 --stiffness 1e7 --asperity-stiffness 1e9"
runs "hard grains" $film --steps-per-contact 200
near "$(value restitution)" "$(value restitution_theory)" 2e-3
runs "thick liquid" $alone --volume 0 --viscosity 0.05
expect stuck "== 1"
expect largest_overlap "== 0"
near "$(value dissipated_film) / $(value energy_before)" 1 1e-3

# The books of the film are of the first order in the step.
defects=
for steps in 500 1000 2000 4000; do
  runs "film, $steps steps" $alone --volume 0 --viscosity 0.02 --steps-per-contact $steps
  defects="$defects $(value energy_defect)"
done
awk -v all="$defects" 'BEGIN {
  split(all, d, " ")
  for (i = 2; i <= 4; ++i) { r = d[i - 1] / d[i]; if (!(r > 1.7 && r < 2.4)) exit 1 }
}' </dev/null || fail "energy defects of steps halved:$defects"

# A bridge and no film: it takes what lifts it to its rupture, whatever the grains do in contact.
runs "bridge alone" $alone --viscosity 0 --creation-gap 0 --steps-per-contact 4000
near "$(value restitution)" "$(value restitution_theory)" 1e-4
expect dissipated_film "== 0"
near "$(value dissipated_rupture) / $(value energy_before)" "1 - $(value restitution) ^ 2" 2e-4
gap=$(value rupture_gap)
runs "bridge alone, slow" $alone --viscosity 0 --creation-gap 0 --velocity 0.02
expect stuck "== 1"
expect bridges "== 1"
runs "bridge with an angle" $alone --viscosity 0 --creation-gap 0 --contact-angle 20
expect rupture_gap "> $gap"
runs "less tension, more liquid, heavier, slower" $alone --surface-tension 0.02 --volume 2e-11 --density 8000 --velocity 0.1
runs "thick film, smooth, without friction" $alone --film 1e-4 --roughness 1e-7 --friction 0 --obliquity 20
keys="$pair $cloud $seconds"
files="cloud.csv cloud.svg collision.csv"
runs "a cloud alone: little liquid, packed, finer" --points 0 --grains 40 --time 0.004 --wetness 1 --solid 0.2 --cloud-steps 100
runs "a dry cloud" --points 0 --grains 40 --time 0.004 --viscosity 0 --volume 0
expect cloud_dissipated_film "== 0"
expect cloud_formed "== 0"

helps --radius --radius2 --density --velocity --obliquity --viscosity --film --film-law --roughness --surface-tension \
  --contact-angle --volume --creation-gap --stiffness --asperity-stiffness --friction --steps-per-contact --points \
  --sweep-to --grains --solid --wetness --gravity --time --cloud-steps --seed --out

refuses "unknown option" "surprise" --surprise
refuses "negative radius" "--radius: found \"-1\", expected a number above 0" --radius=-1
refuses "no radius" "--radius: found \"0\", expected a number above 0" --radius 0
refuses "NaN" "--velocity: found \"nan\", expected a number above 0" --velocity nan
refuses "infinite" "--density: found \"inf\", expected a number above 0" --density inf
refuses "no number" "--viscosity: found \"water\", expected a number from 0 on" --viscosity water
refuses "right angle" "--contact-angle: found \"90\", expected a number from 0 to below 90" --contact-angle 90
refuses "negative angle" "--contact-angle: found \"-5\"" --contact-angle=-5
refuses "grazing" "--obliquity: found \"90\"" --obliquity 90
refuses "negative volume" "--volume: found \"-1e-12\", expected a number from 0 on" --volume=-1e-12
refuses "a sea" "--volume: found \"1e-08\", expected below 1e-09, the cube" --volume 1e-8
refuses "negative tension" "--surface-tension: found \"-0.07\"" --surface-tension=-0.07
refuses "rougher than the film" "--roughness: found \"0.0001\", expected below 5e-05, the thickness" --roughness 1e-4
refuses "deep film" "--film: found \"0.01\", expected below 0.001, the smaller radius" --film 0.01
refuses "far" "--creation-gap: found \"0.5\", expected below" --creation-gap 0.5
refuses "no stiffness" "--stiffness: found \"0\"" --stiffness 0
refuses "too soft" "--velocity: found \"0.2\", expected below .*too soft" --stiffness 1
refuses "tar" "--viscosity: found \"1e\+?06\", expected a thinner liquid" --viscosity 1e6
refuses "no asperities" "--asperity-stiffness: found \"0\", expected a number above 0" --asperity-stiffness 0
refuses "too slow" "--velocity: found \"1e-06\", expected a faster approach" --velocity 1e-6
refuses "too long" "--time: found \"1000\", expected at most 1e7 steps" --time 1000
refuses "negative friction" "--friction: found \"-0.1\"" --friction=-0.1
refuses "long steps" "--steps-per-contact: found \"5\", expected a whole number from 20" --steps-per-contact 5
refuses "half a step" "--cloud-steps: found \"50.5\"" --cloud-steps 50.5
refuses "one grain" "--grains: found \"1\", expected 0, or a whole number from 2" --grains 1
refuses "dense cloud" "--solid: found \"0.5\", expected a number above 0, at most 0.2" --solid 0.5
refuses "law" "--film-law: found \"exact\", expected one of leading, accurate" --film-law exact
refuses "ratio" "--radius2: found \"9e-05\", expected at most a ratio of 10" --radius2 9e-5 --film-law accurate --volume 1e-14
refuses "no folder" "--out: found \"\", expected a folder" --out ""
touch occupied
refuses "a file in the way" "--out: found \"occupied\", expected a folder" --out occupied
cannot_write $alone
report

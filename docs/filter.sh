#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# filter.sh HEADER: what doxygen reads instead of the header. Its parser does not know `namespace a::inline b`; and the
# group of everything in a header follows from its folder, so that no header need say it.
case $1 in
  */core/*) group=core ;;
  */geometry/*) group=geometry ;;
  */simplex/*) group=simplices ;;
  */law/*) group=laws ;;
  */network/*) group=network ;;
  */packing/*) group=packing ;;
  */tessellation/*) group=tessellation ;;
  */solver/*) group=solver ;;
  */lbm/*) group=lbm ;;
  */one_phase/*) group=one_phase ;;
  */two_phase/*) group=two_phase ;;
  */io/*) group=io ;;
  *) exec cat "$1" ;;
esac
sed -E 's@^/// (Syntax|Semantics|Models): *@/// \\par \1\n/// @' "$1" | awk -v group="$group" '
  /^namespace tetrapore/ { sub(/::inline TETRAPORE_ABI/, ""); print $0 " /** \\addtogroup " group " \n @{ */"; open = 1; next }
  /^}  \/\/ namespace tetrapore/ && open { print "/** @} */ " $0; open = 0; next }
  /^template / { held = held $0 "\n"; next }
  held != "" { if (/^concept /) printf "/// \\ingroup concepts\n"; printf "%s", held; held = "" }
  { print }
'

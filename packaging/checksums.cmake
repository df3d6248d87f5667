# SPDX-License-Identifier: BSD-3-Clause
# Writes SHA256SUMS of what lies in `folder`: sha256sum --check reads it.
file(GLOB names RELATIVE ${folder} ${folder}/*)
list(REMOVE_ITEM names SHA256SUMS)
set(lines "")
foreach(name IN LISTS names)
  file(SHA256 ${folder}/${name} sum)
  string(APPEND lines "${sum}  ${name}\n")
endforeach()
file(WRITE ${folder}/SHA256SUMS "${lines}")

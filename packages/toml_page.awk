# SPDX-License-Identifier: MIT
# The page plumbline.toml(5), from the example that has every key with its text, range and default.
function plain(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  gsub(/"/, "\\(dq", text)
  sub(/^[.']/, "\\\\\\&&", text)
  return text
}
function tell() {
  if (told != "") print plain(told)
  told = ""
}
BEGIN {
  print ".TH PLUMBLINE.TOML 5 \"\" Plumbline \"File formats\""
  print ".SH NAME\nplumbline.toml \\- what plumblined is told"
  print ".SH SYNOPSIS\n/etc/plumbline/plumbline.toml"
  print ".SH DESCRIPTION\nA file in TOML. Every key may be left out; the value shown is its default."
  print "What is wrong in a file is said, with line and what to write instead, by"
  print ".B plumblined \\-\\-check \\-\\-config"
  print ".IR FILE ,\nand by\n.B plumbline config \\-\\-check"
  print ".IR FILE ."
}
/^\[/ { inside = 1; print ".SH \"" plain($0) "\""; next }
!inside { next }
/^# / { told = told (told == "" ? "" : " ") substr($0, 3); next }
/^#/ { print ".TP\n.B " plain(substr($0, 2)); tell(); next }
/^$/ { tell() }
END {
  print ".SH \"SEE ALSO\"\n.BR plumblined (8),\n.BR plumbline (1)"
}

# Shows Doxygen the comments that our headers have in plain form.

# The first lines say what the file is for.
1 {
  s|^// |/// \\file\n/// |
  : head
  s:<(name|table|stepper)>:\&lt;\1\&gt;:g
  t next
  : next
  n
  s|^//( ?)|///\1|
  t head
}
# A type, a member or an enumerator with its meaning behind it: `struct LoadSpec {  // [load]`, `double t = 0;  // [s]`
s|^((enum class\|struct\|class) [^/]*[{]) +// (.*)|/// \3\n\1|
s|^( *[^/ ].*[^/{ ]) +// (.*)|\1 /**< \2 */|
# A word in angle brackets is no tag, there and above.
/\/\/\/|\/\*\*</s:<(name|table|stepper)>:\&lt;\1\&gt;:g

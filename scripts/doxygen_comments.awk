# Plain comments of a header as Doxygen reads them: the block at its top is the file's, a block above a declaration is that
# declaration's, and a comment behind a member is the member's, with the lines that go on with it.
FNR == 1 && /^\/\/ SPDX/ { print "/// \\file"; next }
/^#/ { top = 1 }
{
    own = match($0, /^ *\/\/ ?/)
    if (own) {
        text = substr($0, RSTART + RLENGTH)
        indent = $0
        sub(/\/\/.*/, "", indent)
        # Goes on with the comment behind the member above.
        if (behind && length(indent) > deep) {
            print indent "///< " text
            next
        }
        behind = 0
        print indent "/// " text
        next
    }
    behind = 0
    at = index($0, "  // ")
    if (at > 1) {
        match($0, /^ */)
        deep = RLENGTH + 4
        behind = 1
        $0 = substr($0, 1, at) " ///< " substr($0, at + 5)
    }
    print
}

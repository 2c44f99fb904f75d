// One value of a namelist from the text at a cursor. Used by the parser only.
#pragma once

#include "io/namelist_cursor.hpp"

namespace cleave::io::namelist {

// Whether a name with its '=' begins here, rather than a word that is a value: '=', '%' or '('
// follows.
bool is_name_next(const Cursor& at);

// Reads one value, no separator and no repeat count; `at` stands on its first character. Throws
// io::Error for anything that is not a value or is not followed by a separator.
Value read_value(Cursor& at);

}  // namespace cleave::io::namelist

// What the program says: messages, which may be lost, and answers, which may not.
#pragma once

#include <string_view>

#include "core/print.h"

namespace etd::cli {

// Makes failing writes errors that can be dropped or told, rather than signals that end the program; and opens standard
// streams that the caller closed, so that they take nothing. Otherwise the first files that are opened would be the
// standard streams, and messages would go into them. Call before anything else.
void prepare_standard_streams();

// Prints problems, warnings and progress to standard error.
template <class... Args>
void tell(fmt::format_string<Args...> format, Args&&... args) {
  print_or_drop(stderr, format, std::forward<Args>(args)...);
}

// Once: that the system gives fewer threads than were wanted.
void tell_of_refused_threads();

// Prints to standard output, beside a product that is a file.
template <class... Args>
void report(fmt::format_string<Args...> format, Args&&... args) {
  print_or_drop(stdout, format, std::forward<Args>(args)...);
}

// Prints the product of the command to standard output.
void answer_text(std::string_view text);
template <class... Args>
void answer(fmt::format_string<Args...> format, Args&&... args) {
  answer_text(fmt::format(format, std::forward<Args>(args)...));
}

// `code`, or `failed` if that is 0 and an answer could not be written, which is then told.
int code_after_answers(int code, int failed);

}  // namespace etd::cli

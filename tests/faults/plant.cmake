# Plants the faults of catalogue.cmake: of each source file that one names, a copy with its faults behind switches goes
# to build/faults/faulty, where headers are looked for before src. The sources themselves know nothing of this. Leaves
# ETENDUE_FAULTY_ROOT, ETENDUE_FAULTY_FILES (relative to src), and the list build/faults/faults.txt with a line for each
# fault: number|name|what is wrong|filter of the tests that are tried.

set(ETENDUE_FAULTY_ROOT ${CMAKE_BINARY_DIR}/faulty)
set(ETENDUE_FAULTY_FILES "")
set(fault_number 0)
set(fault_list "")

# Begins a fault; the edits that follow belong to it.
function(fault name what tests)
  math(EXPR fault_number "${fault_number} + 1")
  set(fault_number ${fault_number} PARENT_SCOPE)
  set(fault_list "${fault_list}${fault_number}|${name}|${what}|${tests}\n" PARENT_SCOPE)
endfunction()

# Replaces `text`, which must stand exactly once in src/`file`; FAULT in the replacement is true while the fault is on.
function(edit file text replacement)
  if(NOT DEFINED "fault_text_${file}")
    file(READ "${CMAKE_SOURCE_DIR}/src/${file}" "fault_text_${file}")
    set(ETENDUE_FAULTY_FILES ${ETENDUE_FAULTY_FILES} ${file} PARENT_SCOPE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${file}")
  endif()
  set(source "${fault_text_${file}}")
  string(FIND "${source}" "${text}" first)
  string(FIND "${source}" "${text}" last REVERSE)
  if(first EQUAL -1 OR NOT first EQUAL last)
    message(FATAL_ERROR "tests/faults/catalogue.cmake: this must stand exactly once in src/${file}:\n${text}")
  endif()
  string(REPLACE "FAULT" "(::etd_faults::active() == ${fault_number})" replacement "${replacement}")
  string(REPLACE "${text}" "${replacement}" source "${source}")
  set("fault_text_${file}" "${source}" PARENT_SCOPE)
endfunction()

include(${CMAKE_CURRENT_LIST_DIR}/catalogue.cmake)

# Writes a file only when its content is new, so that only what changed is compiled again.
function(write_if_new path content)
  set(old "")
  if(EXISTS "${path}")
    file(READ "${path}" old)
  endif()
  if(NOT "x${old}" STREQUAL "x${content}")
    file(WRITE "${path}" "${content}")
  endif()
endfunction()

# Each copy includes the switches itself, so that what sees no fault compiles to what a compiler cache knows already.
foreach(file IN LISTS ETENDUE_FAULTY_FILES)
  write_if_new("${ETENDUE_FAULTY_ROOT}/${file}"
               "#include \"planted.h\"\n${fault_text_${file}}")
endforeach()
file(READ "${CMAKE_CURRENT_LIST_DIR}/planted.h" switches)
write_if_new("${ETENDUE_FAULTY_ROOT}/planted.h" "${switches}")
write_if_new("${CMAKE_BINARY_DIR}/faults.txt" "${fault_list}")

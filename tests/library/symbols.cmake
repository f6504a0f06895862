# Confirms that the library prints nothing and keeps no state between calls:
#
#   cmake -D NM=nm -D LIBRARY=liblayout_embedding.a -P symbols.cmake
#
# What a function keeps from its first call on is a constant, and listed here.
set(constants
  "all_error_infos\\(\\)::table"
  "patch_palette\\(\\)::palette"
  "tube\\(.*\\)::circle"
  "GlbReader::list\\(.*\\)::none")
set(printing
  "std::(cin|cout|cerr|clog|wcout|wcerr)$" "std::ios_base::Init"
  " (printf|vprintf|puts|putchar|fprintf|vfprintf|fputs|fputc|fwrite|stdout|stderr)$")

execute_process(COMMAND ${NM} -C --format=sysv ${LIBRARY} OUTPUT_VARIABLE symbols
                COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "," symbols "${symbols}")
string(REGEX MATCHALL "[^\n]+" symbols "${symbols}")
list(LENGTH symbols count)
if(count LESS 1000)
  message(FATAL_ERROR "only ${count} symbols in ${LIBRARY}")
endif()

set(failures "")
foreach(line IN LISTS symbols)
  string(REPLACE "|" ";" columns "${line}")
  list(GET columns 0 name)
  string(STRIP "${name}" name)
  if(line MATCHES "\\|\\.(t?bss|t?data)(\\.[A-Za-z0-9_.]+)?$" AND NOT line MATCHES "\\.data\\.rel\\.")
    set(known FALSE)
    foreach(constant IN LISTS constants)
      if(name MATCHES "${constant}$")
        set(known TRUE)
      endif()
    endforeach()
    if(NOT known)
      list(APPEND failures "state: ${name}")
    endif()
  elseif(line MATCHES "\\|\\*UND\\*")
    foreach(pattern IN LISTS printing)
      if(" ${name}" MATCHES "${pattern}")
        list(APPEND failures "printing: ${name}")
      endif()
    endforeach()
  endif()
endforeach()
if(failures)
  list(JOIN failures "\n  " text)
  message(FATAL_ERROR "${LIBRARY} has\n  ${text}")
endif()

# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` and scripts/package put on a machine, besides the programs: a man page of each,
# made from its --help, completion for bash, the licence; and the Debian package of it all.

# Installing builds nothing: the programs are built before, and tests are not installed.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

get_property(INSITU_PROGRAMS GLOBAL PROPERTY INSITU_PROGRAMS)
find_program(HELP2MAN help2man)
if(HELP2MAN)
  foreach(program IN LISTS INSITU_PROGRAMS)
    set(page ${CMAKE_BINARY_DIR}/man/${program}.1)
    install(CODE "
      file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/man)
      execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND ${CMAKE_COMMAND} -E env SOURCE_DATE_EPOCH=0
        ${HELP2MAN} --no-info --no-discard-stderr --name=${program} --manual=insitu
        --output=${page} $<TARGET_FILE:${program}>)")
    install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  endforeach()
else()
  install(CODE "message(WARNING \"no man pages: help2man (Debian package help2man) is missing\")")
endif()
install(FILES scripts/completion.bash RENAME insitu
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/insitu)
install(FILES README.md CHANGELOG.md CONVENTIONS.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/insitu)

# The material library, for people to read and to copy from, too.
install(DIRECTORY radiometry/library/data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/insitu/library)

# What people write, told file by file, and the schemas by which editors help with it.
install(FILES reconstruction/FILES.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/insitu)
install(DIRECTORY reconstruction/schemas/ DESTINATION ${CMAKE_INSTALL_DATADIR}/insitu/schemas)

# What reads IFC, as scripts/setup has fetched it; without it IFC is refused. What turns previews.
install(FILES build/web-ifc/web-ifc-api-node.js build/web-ifc/web-ifc-node.wasm
    build/web-ifc/LICENSE.md build/web-ifc/package.json
  DESTINATION ${CMAKE_INSTALL_DATADIR}/insitu/web-ifc OPTIONAL)
install(FILES build/three/three.min.js build/three/OrbitControls.js build/three/LICENSE
  DESTINATION ${CMAKE_INSTALL_DATADIR}/insitu/three OPTIONAL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the insitu authors <insitu@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "planned buildings in photographs of their site, to be checked")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# Libraries as the programs are linked; then the programs that ours run.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-mrcal, mrcal, mrgingham, colmap, nodejs")
include(CPack)

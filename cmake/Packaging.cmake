# The Debian packages of the program, its Python module and its manual (`make package`): CPack, dependencies found by dpkg-shlibdeps, manual page and
# completions made from what the program says of itself (tools/command_pages.py).
set(pages ${CMAKE_BINARY_DIR}/pages)
add_custom_command(
  OUTPUT ${pages}/carom.1.gz ${pages}/changelog.gz
  COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tools/command_pages.py $<TARGET_FILE:carom> ${pages}
  COMMAND gzip -9nf ${pages}/carom.1
  COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tools/debian_texts.py ${PROJECT_VERSION} ${pages}
  DEPENDS carom ${CMAKE_SOURCE_DIR}/tools/command_pages.py ${CMAKE_SOURCE_DIR}/tools/debian_texts.py
  VERBATIM)
add_custom_target(pages DEPENDS ${pages}/carom.1.gz)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(FILES ${pages}/carom.1.gz DESTINATION share/man/man1)
install(FILES ${pages}/carom.bash DESTINATION share/bash-completion/completions RENAME carom)
install(FILES ${pages}/_carom DESTINATION share/zsh/vendor-completions)
install(FILES ${pages}/copyright ${pages}/changelog.gz README.md DESTINATION share/doc/carom)
# `carom init` reads what stands in share/carom (src/casefile/example_cases.hpp).
install(DIRECTORY cases DESTINATION share/carom PATTERN "stiffness" EXCLUDE)
install(DIRECTORY examples/tutorial examples/gallery DESTINATION share/carom/examples)
install(FILES ${pages}/copyright ${pages}/changelog.gz DESTINATION share/doc/python3-carom COMPONENT python)
install(DIRECTORY examples/laws examples/format DESTINATION share/doc/carom/examples)
install(FILES ${pages}/copyright ${pages}/changelog.gz DESTINATION share/doc/carom-doc COMPONENT doc)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/build/manual/ DESTINATION share/doc/carom/html COMPONENT doc)  # of tools/manual.py
install(DIRECTORY examples/python/ DESTINATION share/doc/python3-carom/examples COMPONENT python)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program python doc)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME carom)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-carom)
set(CPACK_DEBIAN_DOC_PACKAGE_NAME carom-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-meshio, python3-matplotlib, python3-scipy")
set(CPACK_PACKAGE_NAME carom)
set(CPACK_PACKAGE_CONTACT "The Carom developers <carom@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "impact dynamics of deformable solids")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Carom computes impacts of deformable solids: what happens in the
microseconds when a body strikes another, with the contact forces, the
waves, and where every joule went. Implicit and explicit steps, contact
with friction, bodies that yield; every run closes an energy ledger and
ends with a verdict.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "Module of Python: cases as dicts, runs stepped and branched, curves as
arrays: the solver carom as a module of Python.")
set(CPACK_COMPONENT_DOC_DESCRIPTION
    "Manual: tutorial, how-tos, reference and verification of the solver
carom, pages with a search that need no network.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
include(CPack)

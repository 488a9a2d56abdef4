# cmake --install: the program, its experiments, schema and references, the library with its headers, the Python package,
# the manual page and completion for bash and zsh. cpack makes a Debian package of the same.
set(data ${CMAKE_INSTALL_DATADIR}/bristle)  # src/util/data.cpp finds it from the program

install(TARGETS bristle RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS libbristle EXPORT bristle ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/bristle DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/bristle)
install(EXPORT bristle NAMESPACE bristle:: FILE bristleTargets.cmake DESTINATION ${config})
install(FILES cmake/bristleConfig.cmake DESTINATION ${config})
include(CMakePackageConfigHelpers)
string(REGEX REPLACE -.* "" number ${BRISTLE_VERSION})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bristleConfigVersion.cmake VERSION ${number}
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bristleConfigVersion.cmake DESTINATION ${config})

# The experiments with reference values: others in this folder are the user's own.
file(GLOB references RELATIVE ${PROJECT_SOURCE_DIR}/reference CONFIGURE_DEPENDS reference/*.json)
foreach(name paper.json ${references})
  if(EXISTS ${PROJECT_SOURCE_DIR}/experiments/${name})
    install(FILES experiments/${name} DESTINATION ${data}/experiments)
  endif()
endforeach()
install(DIRECTORY experiments/assumptions DESTINATION ${data}/experiments FILES_MATCHING PATTERN "*.json")
install(DIRECTORY reference DESTINATION ${data} FILES_MATCHING PATTERN "*.json")
install(FILES ${PROJECT_BINARY_DIR}/experiment.schema.json DESTINATION ${data})
# The path that Debian's Python searches below /usr. Below another prefix, PYTHONPATH has to name it.
install(DIRECTORY python/bristle DESTINATION lib/python3/dist-packages PATTERN __pycache__ EXCLUDE)
install(PROGRAMS scripts/plot DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME bristle-plot)
install(DIRECTORY scripts/slurm DESTINATION ${data} USE_SOURCE_PERMISSIONS)
install(PROGRAMS scripts/find-python DESTINATION ${data})
install(FILES ${PROJECT_BINARY_DIR}/bristle.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES cmake/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME bristle)
# zsh looks into the first folder below /usr/local, and on Debian into the second one below /usr.
foreach(folder site-functions vendor-completions)
  install(FILES cmake/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder} RENAME _bristle)
endforeach()
install(FILES README.md LICENSE CITATION.cff CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
string(REPLACE - ~ CPACK_PACKAGE_VERSION ${BRISTLE_VERSION})  # 0.2.0~dev is before 0.2.0
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/dist)
set(CPACK_PACKAGE_CONTACT "the maintainers of bristle")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "friction of a bristle lattice under a sliding slab")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-h5py, python3-matplotlib, python3-xarray, python3-h5netcdf, python3-jinja2, python3-yaml")
include(CPack)

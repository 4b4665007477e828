"""gl_functions.py GLAD_HEADER FOLDER: glad's header for several contexts, made ours.

Writes functions.h and functions.c. All names that glad would export get a prefix, so that a program may link a glad of
its own. OpenGL's functions keep their names, as macros: each calls the context that is current on this thread."""
import pathlib
import re
import sys

header, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
text = header.read_text()
text = re.sub(r"\bgladLoadGL", "pinocchio_gladLoadGL", re.sub(r"\bGladGLContext\b", "PinocchioGladGLContext", text))
table = re.search(r"typedef struct PinocchioGladGLContext \{(.*?)\} PinocchioGladGLContext;", text, re.S).group(1)
functions = re.findall(r"^\s+PFN\w+PROC (\w+);$", table, re.M)
macros = "".join(f"#define gl{name} (::pinocchio::gl::current->functions.{name})\n" for name in functions)
folder.mkdir(parents=True, exist_ok=True)
(folder / "functions.h").write_text(f"{text}\n#ifdef __cplusplus\n{macros}#endif\n")
(folder / "functions.c").write_text('#define GLAD_GL_IMPLEMENTATION\n#include "functions.h"\n')

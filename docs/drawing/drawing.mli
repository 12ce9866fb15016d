(** Draws the libraries of this project, by its dune files, into a page.

    [drawing.exe print PAGE FOLDER ...] prints PAGE with a graph in Mermaid between the lines [<!-- drawing -->] and
    [<!-- end of drawing -->]: a node for each library, or executable with a public name, that a [dune] file somewhere
    in the folders defines, and an arrow to each other one that it uses and that no other arrows lead to.

    [drawing.exe check PAGE FOLDER ...] fails if no row of a table in PAGE begins with the folder of one of them, or if
    PAGE names a path in one of the folders, between backquotes, that is not there. *)

autocmd BufRead,BufNewFile *.dol,*.dolphin,*.fleet set filetype=dolphin

autocmd BufNewFile,BufRead *.hsd setfiletype hsd

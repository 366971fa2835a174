;;; hsd-mode.el --- Major mode for HSD house files  -*- lexical-binding: t; -*-

;; Version: 0.1.0
;; Package-Requires: ((emacs "27.1"))
;; Keywords: languages
;; SPDX-License-Identifier: MIT OR Apache-2.0

;;; Commentary:

;; A major mode for .hsd files in both forms, five-column codes and XML, with the language server `hsd lsp' through
;; eglot (built in since Emacs 29, a package before).
;;
;;   (add-to-list 'load-path "/path/to/hsd/editors/emacs")
;;   (require 'hsd-mode)
;;   (add-hook 'hsd-mode-hook #'eglot-ensure)

;;; Code:

(defgroup hsd nil
  "HSD house files."
  :group 'languages)

(defcustom hsd-program "hsd"
  "The compiler, which is also the language server."
  :type 'string)

(defface hsd-width
  '((t :inherit font-lock-constant-face))
  "The width in the fifth column of a code.")

(defun hsd--xml-p ()
  "Return non-nil if the buffer is in the XML form.
Its first character other than blanks is then `<'."
  (save-excursion
    (save-restriction
      (widen)
      (goto-char (point-min))
      (skip-chars-forward " \t\r\n\f\ufeff")
      (eq (char-after) ?<))))

;;; Highlighting

(defconst hsd--setting
  "^[ \t]*\\(unit\\|seed\\|roofs\\|method\\|street\\|name\\|age\\|era\\)\\>[ \t]*\\(.*\\)$"
  "A line of the header: key and value.")

(defconst hsd--number "[-+]?\\(?:[0-9]+\\(?:\\.[0-9]*\\)?\\|\\.[0-9]+\\)"
  "A number.")

(defconst hsd--roof
  (concat "^[ \t]*\\([KGISHYT*]\\)[ \t]+\\([XYFBLR*]\\)[ \t]+\\(" hsd--number
          "\\|\\*\\)\\(?:[ \t]+\\([A-Z*]+\\)\\)?\\(.*\\)$")
  "A roof line: covering, direction, height, shape, the rest.")

(defun hsd--wall-line-p ()
  "Return non-nil if point is on a line of codes."
  (save-excursion
    (beginning-of-line)
    (not (or (looking-at "[ \t]*\\(?:$\\|[#%;/]\\|[-+]?\\.?[0-9]\\)")
             (looking-at hsd--setting)
             (looking-at hsd--roof)))))

(defun hsd--next-code (limit)
  "Find the next code before LIMIT.
Its name is group 1, its width 2, a void 3, a control letter 4."
  (let (found)
    (while (and (not found) (< (point) limit))
      (if (or (eolp) (and (bolp) (not (hsd--wall-line-p))))
          (forward-line 1)
        (setq found
              (or (looking-at "\\(?3:\\.\\.\\.\\.\\.\\)")
                  (looking-at "\\(?4:[LR^]\\)[ \t]*$")
                  (looking-at "\\(?4:\\^\\)")
                  (looking-at "\\(?1:[^ \n^][^\n^]\\{3\\}\\)\\(?2:[0-9h]\\)")
                  (looking-at "\\(?1:[^\n^]\\{1,5\\}\\)")))
        (goto-char (if found (match-end 0) (line-end-position)))
        (when (= (match-beginning 0) (match-end 0))
          (setq found nil)
          (forward-line 1))))
    found))

(defun hsd--in (form matcher)
  "Restrict MATCHER to buffers in the FORM `xml' or `legacy'."
  (lambda (limit)
    (and (eq (hsd--xml-p) (eq form 'xml))
         (if (functionp matcher)
             (funcall matcher limit)
           (let ((case-fold-search nil))
             (re-search-forward matcher limit t))))))

(defconst hsd--legacy-keywords
  `((,(hsd--in 'legacy "^\\(%\\)") 1 'font-lock-keyword-face)
    (,(hsd--in 'legacy hsd--setting) (1 'font-lock-keyword-face) (2 'font-lock-string-face))
    (,(hsd--in 'legacy (concat "^[ \t]*" hsd--number "\\(?:[ \t]+" hsd--number "\\)*"))
     0 'font-lock-constant-face)
    (,(hsd--in 'legacy hsd--roof)
     (1 'font-lock-type-face)
     (2 'font-lock-builtin-face)
     (3 'font-lock-constant-face)
     (4 'font-lock-type-face nil t)
     (5 'font-lock-constant-face))
    (,(hsd--in 'legacy #'hsd--next-code)
     (1 'font-lock-function-name-face nil t)
     (2 'hsd-width nil t)
     (3 'font-lock-doc-face nil t)
     (4 'font-lock-keyword-face nil t)))
  "Highlighting of the legacy form.")

(defconst hsd--xml-keywords
  `((,(hsd--in 'xml "<[?!][^>\n]*>") 0 'font-lock-preprocessor-face)
    (,(hsd--in 'xml "</?\\([[:alpha:]_:][^ \t\n/>\"'<]*\\)") 1 'font-lock-keyword-face)
    (,(hsd--in 'xml "\\_<\\([[:alpha:]_:][[:alnum:]_:.-]*\\)=\\(\"[^\"<]*\"\\|'[^'<]*'\\)")
     (1 'font-lock-variable-name-face)
     (2 'font-lock-string-face))
    (,(hsd--in 'xml "{[^{}\n]*}") 0 'font-lock-builtin-face t)
    (,(hsd--in 'xml "&[#[:alnum:]]+;") 0 'font-lock-constant-face prepend)
    (,(hsd--in 'xml "[>}]\\([^<>{}\n]+\\)") 1 'font-lock-function-name-face keep)
    (,(hsd--in 'xml "^[ \t]*\\([^ \t\n<>{}\"'=][^<>{}\"'=\n]*\\)\\(?:$\\|[<{]\\)") 1 'font-lock-function-name-face keep))
  "Highlighting of the XML form.")

(defconst hsd--syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?\n ">" table)
    (modify-syntax-entry ?\" "." table)
    (modify-syntax-entry ?' "." table)
    (modify-syntax-entry ?_ "_" table)
    (modify-syntax-entry ?< "." table)
    (modify-syntax-entry ?> "." table)
    table)
  "The syntax table.
The start of comments is set by `hsd--propertize', since `#' begins one only
at the start of a line.")

(defun hsd--propertize (start end)
  "Set the syntax of comment delimiters between START and END."
  (goto-char start)
  (if (hsd--xml-p)
      (funcall
       (syntax-propertize-rules
        ("\\(<\\)!--" (1 "< b"))
        ("--\\(>\\)" (1 "> b")))
       start end)
    (funcall (syntax-propertize-rules ("^[ \t]*\\(#\\)" (1 "<"))) start end)))

;;; The mode

(defvar hsd-mode-map
  (let ((map (make-sparse-keymap)))
    (define-key map (kbd "TAB") #'hsd-next-column)
    map)
  "Keys of `hsd-mode'.")

(defun hsd-next-column ()
  "Insert blanks up to the next code; in the XML form indent."
  (interactive)
  (if (hsd--xml-p)
      (indent-for-tab-command)
    (insert-char ?\s (- 5 (mod (current-column) 5)))))

(defun hsd--keep-blanks ()
  "Disable the trimming of trailing blanks on saving: they are significant."
  (let ((trimmers '(delete-trailing-whitespace whitespace-cleanup ws-butler-before-save)))
    (setq-local before-save-hook
                (delq nil
                      (mapcar (lambda (f) (unless (memq f trimmers) f))
                              (append (remq t before-save-hook) (default-value 'before-save-hook))))))
  (setq-local editorconfig-trim-whitespaces-mode #'ignore)
  (setq-local whitespace-action nil)
  (setq-local show-trailing-whitespace nil))

;;;###autoload
(define-derived-mode hsd-mode prog-mode "HSD"
  "Major mode for HSD house files."
  :syntax-table hsd--syntax-table
  (let ((xml (hsd--xml-p)))
    (setq-local comment-start (if xml "<!-- " "# "))
    (setq-local comment-end (if xml " -->" ""))
    (setq-local comment-start-skip (if xml "<!--[ \t]*" "#+[ \t]*"))
    (setq-local comment-end-skip (if xml "[ \t]*--[ \t\n]*>" nil))
    (setq-local comment-column 0)
    (setq-local indent-tabs-mode nil)
    (setq-local tab-width (if xml 2 5))
    ;; An extra blank at the start of a line would shift all its codes.
    (setq-local electric-indent-inhibit t)
    (setq-local indent-line-function (if xml #'indent-relative-first-indent-point #'ignore)))
  (setq-local syntax-propertize-function #'hsd--propertize)
  (setq-local font-lock-defaults
              (list (append hsd--legacy-keywords hsd--xml-keywords) nil nil nil))
  (hsd--keep-blanks))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.hsd\\'" . hsd-mode))

(defvar eglot-server-programs)

(defun hsd--server (&rest _)
  "The command of the language server."
  (list hsd-program "lsp"))

(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs '(hsd-mode . hsd--server)))

(declare-function eglot-current-server "eglot")
(declare-function eglot--TextDocumentIdentifier "eglot")
(declare-function jsonrpc-request "jsonrpc")

(defun hsd-view ()
  "Open the live preview of this buffer, including unsaved changes."
  (interactive)
  (let ((server (or (eglot-current-server) (user-error "Start eglot first"))))
    (browse-url
     (jsonrpc-request server :workspace/executeCommand
                      (list :command "hsd.view"
                            :arguments (vector (plist-get (eglot--TextDocumentIdentifier) :uri) :json-false))))))

(provide 'hsd-mode)
;;; hsd-mode.el ends here
